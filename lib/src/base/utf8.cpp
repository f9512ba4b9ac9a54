#include "base/utf8.hpp"

namespace meshcontour::detail {

DecodedCharacter decode_utf8(std::string_view text, bool* valid) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const auto result = [&](char32_t code, std::size_t length, bool good) {
    if (valid != nullptr) *valid = good;
    return DecodedCharacter{code, length};
  };
  const unsigned lead = byte(0);
  if (lead < 0x80) return result(lead, 1, true);
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < length) return result(kReplacementCharacter, 1, false);
  char32_t code = lead & (0x7Fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return result(kReplacementCharacter, 1, false);
    code = code << 6 | (byte(i) & 0x3Fu);
  }
  const bool overlong = code < (length == 4 ? 0x10000u : length == 3 ? 0x800u : 0x80u);
  const bool surrogate = code >= 0xD800 && code < 0xE000;
  if (overlong || surrogate || code > 0x10FFFF) return result(kReplacementCharacter, 1, false);
  return result(code, length, true);
}

}  // namespace meshcontour::detail
