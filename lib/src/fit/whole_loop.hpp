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

/// The same for an open chain of at least 2 points, without knots at the second and the last but one of four
/// or more (not-a-knot); through two or three points the polynomial.
ParametrizedCurve open_interpolation(std::span<const Point> points);

/// The same with given parameters, one a point and increasing, from 0; for a closed loop the first point's
/// again at the end.
ParametrizedCurve interpolation(std::span<const Point> points, std::span<const double> parameters,
                                bool closed);

}  // namespace meshcontour::detail
