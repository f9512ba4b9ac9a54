#include "base/text_source.hpp"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "base/text_cursor.hpp"
#include "support/catch.hpp"

using namespace meshcontour::detail;
namespace fs = std::filesystem;

namespace {

// A file of its own for a test, removed at the end.
class Sample {
 public:
  explicit Sample(const std::string& text)
      : path_(fs::temp_directory_path() / ("meshcontour_source_" + std::to_string(::getpid()))) {
    std::ofstream(path_, std::ios::binary) << text;
  }
  ~Sample() { fs::remove(path_); }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

std::string text_of(std::size_t size) {
  std::string text(size, ' ');
  for (std::size_t i = 0; i < size; ++i)
    text[i] = i % 7 == 0 ? '\n' : i % 11 == 0 ? '\r' : static_cast<char>('a' + i % 23);
  return text;
}

}  // namespace

TEST_CASE("TextSource: parts of a file are those of the text, with a guard behind them", "[base]") {
  const std::string text = text_of(700'000);
  const Sample sample(text);
  const InputFile file(sample.path());
  const TextSource from_file(file), from_memory(text);
  std::string buffer;
  for (const auto& [begin, end] :
       {std::pair<std::size_t, std::size_t>{0, 10}, {5, 300'000}, {699'990, 800'000}, {900'000, 900'001}}) {
    const std::string_view seen = from_file.view(begin, end, buffer);
    CHECK((seen == from_memory.view(begin, end, buffer)));
    CHECK(std::string_view(seen.data() + seen.size(), 2) == std::string_view("<\0", 2));
  }
}

TEST_CASE("TextSource: a cut source ends there", "[base]") {
  TextSource source("abcdef");
  source.cut(4);
  std::string buffer;
  CHECK(source.size() == 4);
  CHECK(source.view(2, 9, buffer) == "cd");
}

TEST_CASE("TextWindow: moves forward, back and grows", "[base]") {
  const std::string text = text_of(900'000);
  const Sample sample(text);
  const InputFile file(sample.path());
  const TextSource source(file);
  TextWindow window(source);
  for (const std::size_t offset : {0u, 262'000u, 600'000u, 10u, 899'999u, 900'000u}) {
    for (const std::size_t length : {1u, 300u, 400'000u}) {
      window.show(offset, length);
      const std::size_t end = std::min<std::size_t>(offset + length, text.size());
      REQUIRE(window.begin() <= offset);
      REQUIRE(window.end() >= end);
      CHECK((window.part(offset, end) == std::string_view(text).substr(offset, end - offset)));
      CHECK((window.end() < text.size()) == !window.reaches_end());
    }
  }
}

TEST_CASE("TextWindow: a file cut meanwhile just ends", "[base]") {
  const Sample sample(text_of(900'000));
  const InputFile file(sample.path());
  const TextSource source(file);
  TextWindow window(source);
  fs::resize_file(sample.path(), 300'000);
  window.show(299'000, 5000);
  CHECK(window.end() == 300'000);
  CHECK(window.reaches_end());
  window.show(500'000, 10);
  CHECK(window.text().empty());
  CHECK(window.reaches_end());
}

TEST_CASE("BufferPool: a buffer comes back", "[base]") {
  BufferPool pool;
  std::string buffer = pool.take();
  CHECK(buffer.empty());
  buffer.resize(100);
  pool.give_back(std::move(buffer));
  CHECK(pool.take().size() == 100);
  CHECK(pool.take().empty());
}
