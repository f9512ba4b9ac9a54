#include "base/line_counter.hpp"

#include <algorithm>
#include <string>
#include <string_view>

namespace meshcontour::detail {
namespace {

constexpr std::size_t kPart = std::size_t{256} << 10;

// Line ends in a part of a text.
struct LineEnds {
  std::size_t count = 0;
  std::size_t last = std::string_view::npos;  // offset behind the last of them; npos if there is none
};

// If the text goes on with an LF, a CR at the end of the part does not count.
LineEnds count_line_ends(std::string_view part, bool lf_follows) {
  LineEnds ends;
  ends.count = static_cast<std::size_t>(std::count(part.begin(), part.end(), '\n'));
  for (std::size_t i = part.find('\r'); i < part.size(); i = part.find('\r', i + 1)) {
    const bool before_lf = i + 1 < part.size() ? part[i + 1] == '\n' : lf_follows;
    if (!before_lf) ++ends.count;
  }
  const bool unfinished = lf_follows && part.ends_with('\r');
  const std::size_t last = part.substr(0, part.size() - (unfinished ? 1 : 0)).find_last_of("\n\r");
  if (last != part.npos) ends.last = last + 1;
  return ends;
}

}  // namespace

std::size_t LineCounter::line(std::size_t offset) {
  count_to(offset);
  return line_;
}

std::size_t LineCounter::column(std::size_t offset) {
  count_to(offset);
  return counted_ - line_start_ + 1;
}

void LineCounter::count_to(std::size_t offset) {
  offset = std::clamp(offset, start_, std::max(start_, source_.size()));
  if (offset < counted_) {
    counted_ = line_start_ = start_;
    line_ = start_line_;
  }
  std::string buffer;
  while (counted_ < offset) {
    const std::size_t end = std::min(offset, counted_ + kPart);
    const std::string_view seen = source_.view(counted_, end + 1, buffer);
    const std::string_view part = seen.substr(0, end - counted_);
    if (part.empty()) return;  // the file has become shorter
    const LineEnds ends = count_line_ends(part, seen.substr(part.size()).starts_with('\n'));
    line_ += ends.count;
    if (ends.last != std::string_view::npos) line_start_ = counted_ + ends.last;
    counted_ += part.size();
  }
}

}  // namespace meshcontour::detail
