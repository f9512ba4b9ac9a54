#include "base/line_counter.hpp"

#include <string>

#include "support/catch.hpp"

using namespace meshcontour::detail;

namespace {

struct Place {
  std::size_t line = 1, column = 1;
};

// Byte by byte; the second byte of CR LF is in the line that they end.
Place place_of(const std::string& text, std::size_t offset) {
  Place place;
  for (std::size_t i = 0; i < offset; ++i) {
    ++place.column;
    if (text[i] == '\n' || (text[i] == '\r' && text[i + 1] != '\n')) place = {place.line + 1, 1};
  }
  return place;
}

}  // namespace

TEST_CASE("LineCounter: lines are counted alike for every line end and in any order of questions", "[base]") {
  const std::string end = GENERATE("\n", "\r", "\r\n");
  const std::string text = "ab" + end + end + "c";
  LineCounter lines{TextSource(text)};
  CHECK(lines.line(text.size() - 1) == 3);
  CHECK(lines.column(text.size() - 1) == 1);
  CHECK(lines.line(1) == 1);
  CHECK(lines.column(1) == 2);
  CHECK(lines.line(text.size() + 10) == 3);
}

TEST_CASE("LineCounter: counts as one byte after the other does, over the ends of its parts", "[base]") {
  std::string text(600'000, 'x');
  for (std::size_t i = 0; i < text.size(); i += 1 + i % 97) text[i] = i % 3 == 0 ? '\r' : '\n';
  text.replace(262'143, 2, "\r\n");
  text.replace(524'287, 2, "\r\n");
  const TextSource source(text);
  LineCounter lines(source);
  for (const std::size_t offset :
       {0u, 9u, 262'143u, 262'144u, 262'145u, 524'288u, 524'289u, 599'999u, 262'144u}) {
    CHECK(lines.line(offset) == place_of(text, offset).line);
    CHECK(lines.column(offset) == place_of(text, offset).column);
  }
  CHECK(lines.line(700'000) == place_of(text, text.size()).line);
  LineCounter later(source, 262'145, place_of(text, 262'145).line);
  CHECK(later.line(599'999) == place_of(text, 599'999).line);
}
