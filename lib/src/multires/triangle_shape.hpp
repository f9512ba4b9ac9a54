#pragma once

#include <algorithm>
#include <numbers>

#include "meshcontour/types.hpp"

namespace meshcontour::detail {

/// The area of a triangle beside the squares of its sides: 1 for an equilateral triangle, 0 for a line; below
/// 0 where the doubled area is. For what must not become flat or turn over, as it is cheap beside the area.
inline double triangle_shape(double doubled_area, double squared_sides) {
  return squared_sides > 0 ? 2 * std::numbers::sqrt3 * doubled_area / squared_sides : 0;
}

/// The same by its corners; never below 0.
inline double triangle_shape(const Point& a, const Point& b, const Point& c) {
  return triangle_shape((b - a).cross(c - a).norm(),
                        (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm());
}

/// The cosine of the smallest angle of a triangle: 1/2 for an equilateral triangle, 1 for a line. For which
/// of two diagonals to take: with the smaller of their largest values the triangles are those of Delaunay in
/// the plane.
inline double cosine_of_smallest_angle(const Point& a, const Point& b, const Point& c) {
  const auto cosine = [](const Point& at, const Point& p, const Point& q) {
    return (p - at).normalized().dot((q - at).normalized());
  };
  return std::max({cosine(a, b, c), cosine(b, c, a), cosine(c, a, b)});
}

}  // namespace meshcontour::detail
