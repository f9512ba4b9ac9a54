#pragma once

#include <fmt/compile.h>
#include <fmt/format.h>

#include <iterator>
#include <string_view>
#include <utility>

#include "meshcontour/output.hpp"

namespace meshcontour::detail {

/// Formats text into a sink in large pieces. Numbers are printed as the shortest text that reads back the
/// same, whatever the locale. Call flush() at the end.
class TextWriter {
 public:
  explicit TextWriter(Sink& sink) : sink_(sink) {}

  template <typename... Arguments>
  void print(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(buffer_), format, std::forward<Arguments>(arguments)...);
    if (buffer_.size() >= kPiece) flush();
  }

  /// The same for a FMT_COMPILE'd format: 2.5 times as fast, for what is printed by the million.
  template <typename Format, typename... Arguments>
  void compiled(const Format& format, const Arguments&... arguments) {
    fmt::format_to(std::back_inserter(buffer_), format, arguments...);
    if (buffer_.size() >= kPiece) flush();
  }

  void text(std::string_view text) {
    buffer_.append(text);
    if (buffer_.size() >= kPiece) flush();
  }

  void flush() {
    sink_.write({buffer_.data(), buffer_.size()});
    buffer_.clear();
  }

 private:
  static constexpr std::size_t kPiece = std::size_t{1} << 16;

  Sink& sink_;
  fmt::memory_buffer buffer_;
};

}  // namespace meshcontour::detail
