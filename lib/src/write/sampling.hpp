#pragma once

// Curves and chains as points, for formats and readers that know nothing better.

#include <optional>
#include <vector>

#include "write/drawing.hpp"

namespace meshcontour::detail {

/// The ends of a curve.
Point start_of(const Curve& curve);
Point end_of(const Curve& curve);

/// Points on the curve, both ends among them, whose chords stay within about `tolerance` of it; at most 4096
/// a turn or knot span.
std::vector<Point> sampled(const Curve& curve, double tolerance);

/// The points of a chain, each joint once; when closed the first is not repeated at the end.
std::vector<Point> chain_points(const Chain& chain, double tolerance);

/// The diagonal of the box around the ends, centres and control points of a chain.
double chain_size(const Chain& chain);

/// A plane with a frame of its own: a point is origin + x right + y up.
struct Plane {
  Point origin;
  Vector normal;  ///< of length 1

  double distance(const Point& p) const { return std::abs(normal.dot(p - origin)); }
};

/// The plane of the points, its normal towards +z (else +y, else +x), exactly along an axis where it nearly
/// is; nothing if a point is farther than `tolerance` from it. Points on a line have many planes; they get
/// one.
std::optional<Plane> plane_of(const std::vector<Point>& points, double tolerance);

/// The direction, or its opposite, that looks towards +z (else +y, else +x).
Vector upward(const Vector& direction);

}  // namespace meshcontour::detail
