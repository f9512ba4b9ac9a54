#pragma once

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/line_counter.hpp"
#include "meshcontour/error.hpp"
#include "meshcontour/types.hpp"

namespace meshcontour::detail {

/// The number that a whole word spells: finite, decimal, '.' as the decimal mark whatever the locale. A
/// leading '+' is taken. Too large a number is none; too small a one is 0.
std::optional<double> parse_number(std::string_view word);

/// The decimal integer that a whole word spells, if T can hold it; no '+', and no '-' when T is unsigned.
template <typename T>
std::optional<T> parse_integer(std::string_view word) {
  T value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

/// Reads words and numbers one after the other; every failure names file, line and column.
///
/// Words are separated by blanks (space, tab, vertical tab, form feed) and line ends (LF, CR LF, CR). The
/// text is neither copied nor changed.
class TextCursor {
 public:
  /// @param comment  from this character to the end of its line everything is skipped; 0: there are no
  /// comments.
  TextCursor(std::string_view text, std::string name, char comment = '\0');

  /// Skips blanks, line ends and comments; true when nothing else is left.
  bool at_end();
  /// Skips blanks and a comment, but no line end; true when the line, or the text, holds nothing more.
  bool at_line_end();

  /// The next word without taking it; empty at the end.
  std::string_view peek();
  /// @throws Error  BadData at the end of the text.
  std::string_view word();
  /// The next word, which must be this one.
  void expect(std::string_view expected);
  /// @throws Error  BadData unless the next word is a finite number.
  double number();
  /// @throws Error  BadData unless the next word is an integer of this range.
  std::int64_t integer(std::int64_t lowest, std::int64_t highest);
  /// @throws Error  BadData unless the next word is an integer below `count`.
  Index index(std::size_t count);

  /// What is left of the line, without the blanks around it and without its end, which is taken.
  std::string_view rest_of_line();
  /// @throws Error  BadData if the line holds anything more.
  void expect_line_end();

  /// Bytes not taken yet; the bound for every count that a file declares.
  std::size_t remaining() const { return text_.size() - offset_; }
  std::size_t offset() const { return offset_; }
  /// Continues at a later offset, e.g. behind a binary part.
  void skip_to(std::size_t offset);

  /// Place of the word taken last, or of the next one if the last call looked ahead.
  Spot spot() const;
  /// @throws Error  BadData with the message, at spot().
  [[noreturn]] void fail(const std::string& message) const;

 private:
  void skip_blanks();

  std::string_view text_;
  std::string name_;
  char comment_;
  std::size_t offset_ = 0;
  std::size_t word_start_ = 0;
  mutable LineCounter lines_;
};

}  // namespace meshcontour::detail
