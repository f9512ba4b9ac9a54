#pragma once

#include <fmt/compile.h>
#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace meshcontour::detail {

/// A string literal of an exchange file with its quotes: other than ASCII as \X2\ or \X4\ [ISO
/// 10303-21, 6.4.3].
std::string step_string(std::string_view text);

/// Prints as a real: with a point, and E before an exponent. The shortest that reads back the same.
struct StepReal {
  double value;
};

/// Prints as a list of three reals.
struct StepVector {
  const Eigen::Vector3d& value;
};

}  // namespace meshcontour::detail

template <>
struct fmt::formatter<meshcontour::detail::StepReal> {
  constexpr auto parse(format_parse_context& context) { return context.begin(); }

  template <typename Context>
  auto format(meshcontour::detail::StepReal real, Context& context) const {
    std::array<char, 32> digits;
    const auto end = fmt::format_to(digits.begin(), FMT_COMPILE("{}"), real.value);
    const auto exponent = std::find(digits.begin(), end, 'e');
    auto out = std::copy(digits.begin(), exponent, context.out());
    if (std::find(digits.begin(), exponent, '.') == exponent) *out++ = '.';
    if (exponent == end) return out;
    *out++ = 'E';
    return std::copy(exponent + 1, end, out);
  }
};

template <>
struct fmt::formatter<meshcontour::detail::StepVector> {
  constexpr auto parse(format_parse_context& context) { return context.begin(); }

  template <typename Context>
  auto format(meshcontour::detail::StepVector vector, Context& context) const {
    using meshcontour::detail::StepReal;
    const Eigen::Vector3d& v = vector.value;
    return fmt::format_to(context.out(), FMT_COMPILE("({},{},{})"), StepReal{v.x()}, StepReal{v.y()},
                          StepReal{v.z()});
  }
};
