#pragma once

#include <span>

#include "boundary/loops.hpp"

namespace meshcontour::detail {

/// trace_loops for any boundary: several edges at a vertex, edges that run against each other, open ends.
///
/// Each edge has two ends. Ends at a vertex are paired when they bound the same fan of triangles; ends whose
/// fan stops at an edge with three or more triangles are paired among themselves, arriving with leaving ones
/// first. With an odd number of ends at a vertex one stays open. Linear but for sorting the ends and the
/// triangles at vertices with more than two ends.
LoopTrace trace_paired(std::span<const Triangle> triangles, std::span<const BoundaryEdge> edges,
                       std::size_t vertex_bound, Workspace& workspace);

}  // namespace meshcontour::detail
