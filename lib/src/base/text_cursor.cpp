#include "base/text_cursor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meshcontour::detail {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

bool is_line_end(char c) {
  return c == '\n' || c == '\r';
}

// Power of ten of the leading digit of a well-formed number, roughly; its sign tells too large from too
// small.
std::int64_t decimal_magnitude(std::string_view number) {
  const std::size_t mark = std::min(number.find_first_of("eE"), number.size());
  const std::string_view digits = number.substr(0, mark);
  const auto point = static_cast<std::int64_t>(std::min(digits.find('.'), digits.size()));
  const auto first = static_cast<std::int64_t>(std::min(digits.find_first_of("123456789"), digits.size()));
  if (mark == number.size()) return point - first;
  const bool negative = number.substr(mark + 1).starts_with('-');
  number.remove_prefix(mark + (negative || number.substr(mark + 1).starts_with('+') ? 2 : 1));
  constexpr std::int64_t kBeyond = std::int64_t{1} << 40;  // more than a text has digits
  const std::int64_t exponent = parse_integer<std::int64_t>(number).value_or(kBeyond);
  return point - first + (negative ? -1 : 1) * std::min(exponent, kBeyond);
}

std::string quoted(std::string_view word) {
  return word.empty() ? "the end of the file" : fmt::format("'{}'", printable(word, 40));
}

}  // namespace

std::optional<double> parse_number(std::string_view word) {
  if (word.size() > 1 && word.front() == '+' && word[1] != '-') word.remove_prefix(1);
  double value = 0;
  const char* const last = word.data() + word.size();
  const auto [end, error] = std::from_chars(word.data(), last, value);
  if (end != last || error == std::errc::invalid_argument) return std::nullopt;
  if (error == std::errc()) return std::isfinite(value) ? std::optional(value) : std::nullopt;
  if (decimal_magnitude(word) > 0) return std::nullopt;
  return word.front() == '-' ? -0.0 : 0.0;
}

TextCursor::TextCursor(std::string_view text, std::string name, char comment)
    : text_(text), name_(std::move(name)), comment_(comment), lines_(TextSource(text)) {
  if (text_.starts_with("\xEF\xBB\xBF")) offset_ = 3;
}

void TextCursor::skip_blanks() {
  while (offset_ < text_.size() && is_blank(text_[offset_])) ++offset_;
  if (comment_ != '\0' && offset_ < text_.size() && text_[offset_] == comment_) {
    while (offset_ < text_.size() && !is_line_end(text_[offset_])) ++offset_;
  }
}

bool TextCursor::at_line_end() {
  skip_blanks();
  word_start_ = offset_;
  return offset_ == text_.size() || is_line_end(text_[offset_]);
}

bool TextCursor::at_end() {
  while (at_line_end()) {
    if (offset_ == text_.size()) return true;
    ++offset_;
  }
  return false;
}

std::string_view TextCursor::peek() {
  if (at_end()) return {};
  std::size_t end = offset_;
  while (end < text_.size() && !is_blank(text_[end]) && !is_line_end(text_[end]) &&
         (comment_ == '\0' || text_[end] != comment_)) {
    ++end;
  }
  return text_.substr(offset_, end - offset_);
}

std::string_view TextCursor::word() {
  const std::string_view next = peek();
  if (next.empty()) fail("unexpected end of the file");
  offset_ += next.size();
  return next;
}

void TextCursor::expect(std::string_view expected) {
  const std::string_view found = peek();
  if (found != expected) fail(fmt::format("expected '{}', found {}", expected, quoted(found)));
  offset_ += found.size();
}

double TextCursor::number() {
  const std::string_view found = peek();
  const auto value = parse_number(found);
  if (!value) fail(fmt::format("expected a finite number, found {}", quoted(found)));
  offset_ += found.size();
  return *value;
}

std::int64_t TextCursor::integer(std::int64_t lowest, std::int64_t highest) {
  const std::string_view found = peek();
  const auto value = parse_integer<std::int64_t>(found);
  if (!value || *value < lowest || *value > highest) {
    fail(fmt::format("expected an integer from {} to {}, found {}", lowest, highest, quoted(found)));
  }
  offset_ += found.size();
  return *value;
}

Index TextCursor::index(std::size_t count) {
  const std::string_view found = peek();
  const auto value = parse_integer<Index>(found);
  if (!value || *value >= count)
    fail(fmt::format("expected an index below {}, found {}", count, quoted(found)));
  offset_ += found.size();
  return *value;
}

std::string_view TextCursor::rest_of_line() {
  const bool empty = at_line_end();
  std::size_t end = offset_;
  while (end < text_.size() && !is_line_end(text_[end]) && (comment_ == '\0' || text_[end] != comment_))
    ++end;
  std::string_view line = empty ? std::string_view() : text_.substr(offset_, end - offset_);
  while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
  offset_ = end;
  while (offset_ < text_.size() && !is_line_end(text_[offset_])) ++offset_;
  if (text_.substr(offset_).starts_with("\r\n")) ++offset_;
  if (offset_ < text_.size()) ++offset_;
  return line;
}

void TextCursor::expect_line_end() {
  if (!at_line_end()) fail(fmt::format("expected the end of the line, found {}", quoted(peek())));
  rest_of_line();
}

void TextCursor::skip_to(std::size_t offset) {
  offset_ = std::clamp(offset, offset_, text_.size());
  word_start_ = offset_;
}

Spot TextCursor::spot() const {
  return {name_, lines_.line(word_start_), lines_.column(word_start_), ""};
}

void TextCursor::fail(const std::string& message) const {
  throw Error(ErrorCode::BadData, message, spot());
}

}  // namespace meshcontour::detail
