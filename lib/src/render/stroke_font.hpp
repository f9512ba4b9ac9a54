#pragma once

#include <Eigen/Core>
#include <string_view>
#include <vector>

namespace meshcontour::detail {

/// Ends of line segments, two a segment, that write the text: letters are 1 high on a baseline at y = 0, from
/// x = 0. Known are digits, point, signs, the letters of the units of length and X, Y, Z; others leave a gap.
std::vector<Eigen::Vector2d> text_strokes(std::string_view text);

/// The width of the text in letter heights.
double text_width(std::string_view text);

}  // namespace meshcontour::detail
