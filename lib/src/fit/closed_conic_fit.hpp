#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "meshcontour/curve.hpp"

namespace meshcontour::detail {

/// A full circle or ellipse and the largest distance of the fitted points to it.
struct ConicFit {
  Curve curve;
  double residual = 0;
};

/// The circle within `limit` of a ring of points, else the ellipse that is, if there are `ellipse_points` or
/// more. An ellipse whose axes differ by no more than the points scatter is the circle after all, when that
/// is within `tolerance`. O(N).
///
/// @param ring  N >= 5 points, the first not repeated.
std::optional<ConicFit> fit_closed_conic(std::span<const Point> ring, double limit, double tolerance,
                                         std::size_t ellipse_points);

}  // namespace meshcontour::detail
