#pragma once

#include <span>

#include "meshcontour/subdivision.hpp"
#include "multires/level.hpp"

namespace meshcontour::detail {

/// Adds `sign` times their butterfly prediction to the odd points, which stand behind the level.vertex_count
/// even ones.
///
/// @param points  level.vertex_count + level.edge_count().
void add_prediction(const MeshLevel& level, const SubdivisionOptions& options, double sign,
                    std::span<Point> points);

}  // namespace meshcontour::detail
