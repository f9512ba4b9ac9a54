#pragma once

#include <cstddef>
#include <string_view>

namespace meshcontour::detail {

inline constexpr char32_t kReplacementCharacter = 0xFFFD;

/// A character and the bytes it takes.
struct DecodedCharacter {
  char32_t code = 0;
  std::size_t length = 0;
};

/// The first character of a text that is not empty. A byte that starts no valid UTF-8 sequence (overlong, a
/// surrogate, beyond U+10FFFF, cut off) gives U+FFFD with length 1 and `valid` false.
DecodedCharacter decode_utf8(std::string_view text, bool* valid = nullptr);

}  // namespace meshcontour::detail
