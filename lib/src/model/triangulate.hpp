#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "meshcontour/types.hpp"

namespace meshcontour::detail {

/// Cuts a polygon in space into size - 2 triangles that run as it does: a fan from its first corner where it
/// is strictly convex, else ears, seen along the coordinate axis nearest to its normal. Signs are exact.
///
/// Time is linear in the corners plus at most corners x (reflex corners + a constant) up to a fixed budget.
///
/// @param corners  at least 3 indices into points.
/// @param out      receives triples of positions in `corners`, from 0.
/// @return         false if the polygon crosses itself, has no area or used the budget up: then a fan closes
/// it.
bool triangulate(std::span<const Point> points, std::span<const Index> corners,
                 std::vector<std::array<std::uint32_t, 3>>& out);

}  // namespace meshcontour::detail
