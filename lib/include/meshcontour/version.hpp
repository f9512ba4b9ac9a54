#pragma once

#include <string_view>

namespace meshcontour {

/// The library's version, e.g. "1.2.0".
std::string_view version();

}  // namespace meshcontour
