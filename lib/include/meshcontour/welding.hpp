#pragma once

#include <cstddef>

#include "meshcontour/model.hpp"

namespace meshcontour {

/// Makes one point of those that lie together, and renumbers the rest in their order; linear.
///
/// Going through the points in their order, each joins the nearest point that stays and is no farther than
/// the tolerance (of several the first), or stays itself. So no two points that stay are within the
/// tolerance, and none moves by more. Triangles may come to name a point twice: see
/// drop_degenerate_triangles.
///
/// @param tolerance  model units, finite; 0 joins points with equal coordinates, as does a tolerance below
/// the
///                   coordinates' own precision.
/// @return           the number of points that went away.
/// @throws Error     Usage if the tolerance is negative or not finite.
std::size_t weld_points(Shell& shell, double tolerance);

}  // namespace meshcontour
