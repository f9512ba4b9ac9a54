#pragma once

#include <string>
#include <string_view>

namespace meshcontour::detail {

/// The bytes in base64, padded, in one line. [RFC 4648]
std::string base64(std::string_view bytes);

}  // namespace meshcontour::detail
