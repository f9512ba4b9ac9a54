#pragma once

#include <string_view>

namespace meshcontour {

/// The library's version, e.g. "1.2.0".
std::string_view version();

/// The libraries that it was built with and their versions, e.g. "CGAL 5.5.1, Eigen 3.4.0".
std::string_view libraries();

}  // namespace meshcontour
