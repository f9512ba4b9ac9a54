#pragma once

#include <cstddef>

#include "base/text_source.hpp"

namespace meshcontour::detail {

/// Lines and columns of offsets in a source; lines end with LF, CR LF or CR. Counts forward from the last
/// answer, so that rising offsets cost one pass together.
class LineCounter {
 public:
  /// @param start, line  an offset whose line is known; earlier offsets are not asked for.
  explicit LineCounter(TextSource source, std::size_t start = 0, std::size_t line = 1)
      : source_(source), start_(start), start_line_(line), counted_(start), line_(line), line_start_(start) {}
  std::size_t line(std::size_t offset);    ///< from 1
  std::size_t column(std::size_t offset);  ///< from 1, in bytes

 private:
  void count_to(std::size_t offset);

  TextSource source_;
  std::size_t start_, start_line_;
  std::size_t counted_, line_, line_start_;
};

}  // namespace meshcontour::detail
