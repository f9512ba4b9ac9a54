#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace meshcontour::detail {

/// The constrained Delaunay triangulation of the inside of a polygon; O(n log n) on ordinary input.
///
/// @param points  of a closed polygon, in either direction.
/// @return        points.size() - 2 counter-clockwise triangles; none if the polygon meets itself or has no
/// area.
std::vector<std::array<std::size_t, 3>> triangulate_polygon(std::span<const Eigen::Vector2d> points);

}  // namespace meshcontour::detail
