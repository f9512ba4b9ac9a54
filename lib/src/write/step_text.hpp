#pragma once

#include <string>
#include <string_view>

namespace meshcontour::detail {

/// A string literal of an exchange file with its quotes: other than ASCII as \X2\ or \X4\ [ISO
/// 10303-21, 6.4.3].
std::string step_string(std::string_view text);

/// A real: with a point, and E before an exponent. The shortest that reads back the same.
std::string step_real(double value);

}  // namespace meshcontour::detail
