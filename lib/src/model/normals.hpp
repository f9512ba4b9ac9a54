#pragma once

#include <vector>

#include "meshcontour/model.hpp"

namespace meshcontour::detail {

/// The normals that a shell is lit with: the file's own where it has them, turned to the side that the
/// triangle's winding says is outside; else smooth over a patch, but not across edges sharper than 35
/// degrees.
///
/// Angle-weighted sums [Thurmer & Wuthrich 1998]. Linear, but for vertices with up to 64 triangles of a
/// patch, where it compares each with each.
///
/// @return  3 a triangle, of length 1; (0, 0, 1) where a triangle has no area.
std::vector<Eigen::Vector3f> lighting_normals(const Shell& shell, unsigned threads);

}  // namespace meshcontour::detail
