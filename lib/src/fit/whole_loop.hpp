#pragma once

// Curves that take a loop as a whole, without corners: the methods Control and Interpolate.

#include <span>
#include <vector>

#include "meshcontour/curve.hpp"

namespace meshcontour::detail {

/// A curve, and where it passes closest by each point.
struct ParametrizedCurve {
  BSplineCurve curve;
  std::vector<double> parameters;  ///< one a point, increasing
};

/// The closed uniform cubic with these control points, at least 3; point i belongs to the knot where it has
/// its peak.
ParametrizedCurve closed_control_curve(std::span<const Point> points);

/// The clamped uniform cubic with these control points, at least 2; of lower degree with fewer than 4, raised
/// to 3.
ParametrizedCurve open_control_curve(std::span<const Point> points);

/// The periodic cubic through the points, at least 3, consecutive ones distinct; parameters from chord
/// lengths, which make it fourth order [Floater & Surazhsky 2006]. O(N), without pivoting: strictly
/// diagonally dominant.
ParametrizedCurve closed_interpolation(std::span<const Point> points);

/// The same for an open chain of at least 2 points; the end derivatives are those of the cubic through the
/// four points at that end, or of the polynomial through all if there are fewer.
ParametrizedCurve open_interpolation(std::span<const Point> points);

}  // namespace meshcontour::detail
