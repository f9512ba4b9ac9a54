#pragma once

#include <optional>
#include <span>

#include "meshcontour/curve.hpp"

namespace meshcontour::detail {

/// An arc and the largest distance of the fitted points to it.
struct ArcFit {
  CircularArc arc;
  double residual = 0;
};

/// Largest turn between two points of a primitive as seen from its centre, radians.
inline constexpr double kLargestStep = 60 * 3.14159265358979323846 / 180;

/// The largest distance of the points to the segment from the first to the last of them, or nothing if one is
/// farther than `limit` or they do not advance along it.
std::optional<double> line_residual(std::span<const Point> points, double limit);

/// The circular arc from the first to the last point, both held exactly, nearest to those between in least
/// squares: two degrees of freedom, the bulge and the roll of its plane. Nothing if a point is farther than
/// `limit`, the points do not turn one way in steps of at most 60 degrees, or the arc is a line within 3
/// `limit`. Long runs are fitted on 64 of their points and checked on all. O(N).
///
/// @param points  N >= 3.
std::optional<ArcFit> fit_arc(std::span<const Point> points, double limit);

/// The circle nearest to a ring of points, turning as they do and starting nearest to the first: plane of
/// least squares, algebraic start [Kasa 1976], then Gauss-Newton on the distance. Nothing as in fit_arc.
/// O(N).
///
/// @param ring  N >= 3, the first point not repeated.
std::optional<ArcFit> fit_circle(std::span<const Point> ring, double limit);

/// Distance of a point to the circle that carries the arc.
double distance_to_circle(const CircularArc& arc, const Point& point);

}  // namespace meshcontour::detail
