#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace meshcontour::detail {

/// Offset of the first byte that is not valid UTF-8; npos if there is none.
std::size_t find_invalid_utf8(std::string_view text);

/// True for the first bytes of XML in UTF-16, of either byte order, with or without a byte order mark.
bool looks_like_utf16(std::string_view head);

/// UTF-16 as UTF-8; lone surrogates become U+FFFD. A trailing odd byte is dropped.
std::string utf8_from_utf16(std::string_view bytes);

/// ISO-8859-1 as UTF-8.
std::string utf8_from_latin1(std::string_view bytes);

}  // namespace meshcontour::detail
