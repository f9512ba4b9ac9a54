#include "read/encoding.hpp"

#include <cstddef>
#include <cstdint>

#include "base/utf8.hpp"

namespace meshcontour::detail {
namespace {

using namespace std::string_view_literals;

void append_utf8(std::string& text, char32_t code) {
  if (code < 0x80) {
    text += static_cast<char>(code);
    return;
  }
  const int shifts = code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
  const unsigned lead = shifts == 1 ? 0xC0u : shifts == 2 ? 0xE0u : 0xF0u;
  text += static_cast<char>(lead | (code >> (6 * shifts)));
  for (int k = shifts - 1; k >= 0; --k) text += static_cast<char>(0x80u | ((code >> (6 * k)) & 0x3Fu));
}

bool is_big_endian(std::string_view head) {
  return head.starts_with("\xFE\xFF"sv) || head.starts_with("\0<"sv);
}

}  // namespace

bool looks_like_utf16(std::string_view head) {
  return head.starts_with("\xFF\xFE"sv) || head.starts_with("<\0"sv) || is_big_endian(head);
}

std::string utf8_from_utf16(std::string_view bytes) {
  const bool big = is_big_endian(bytes);
  const auto unit = [&](std::size_t i) -> char32_t {
    const auto first = static_cast<unsigned char>(bytes[2 * i]),
               second = static_cast<unsigned char>(bytes[2 * i + 1]);
    return static_cast<char32_t>(big ? first << 8 | second : second << 8 | first);
  };
  const std::size_t count = bytes.size() / 2;
  std::string text;
  text.reserve(count + count / 8);
  for (std::size_t i = count > 0 && unit(0) == 0xFEFF ? 1 : 0; i < count; ++i) {
    char32_t code = unit(i);
    if (code >= 0xD800 && code < 0xDC00 && i + 1 < count && unit(i + 1) >= 0xDC00 && unit(i + 1) < 0xE000) {
      code = 0x10000 + ((code - 0xD800) << 10) + (unit(++i) - 0xDC00);
    } else if (code >= 0xD800 && code < 0xE000) {
      code = 0xFFFD;
    }
    append_utf8(text, code);
  }
  return text;
}

std::size_t find_invalid_utf8(std::string_view text) {
  std::size_t offset = 0;
  bool valid = true;
  while (offset < text.size()) {
    const std::size_t length = decode_utf8(text.substr(offset), &valid).length;
    if (!valid) return offset;
    offset += length;
  }
  return std::string_view::npos;
}

std::string utf8_from_latin1(std::string_view bytes) {
  std::string text;
  text.reserve(bytes.size() + bytes.size() / 8);
  for (const char c : bytes) append_utf8(text, static_cast<unsigned char>(c));
  return text;
}

}  // namespace meshcontour::detail
