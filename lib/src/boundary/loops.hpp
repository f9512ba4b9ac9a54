#pragma once

#include <span>
#include <vector>

#include "boundary/workspace.hpp"
#include "meshcontour/boundary.hpp"

namespace meshcontour::detail {

/// The loops of a patch and what was met on the way.
struct LoopTrace {
  std::vector<BoundaryLoop> loops;
  std::size_t vertices = 0;           ///< boundary vertices, each once
  std::size_t touching_vertices = 0;  ///< vertices with more than two boundary edges
};

/// @param edges         sorted by (from, to); the boundary of `triangles`.
/// @param vertex_bound  above every index of the triangles.
LoopTrace trace_loops(std::span<const Triangle> triangles, std::span<const BoundaryEdge> edges,
                      std::size_t vertex_bound, Workspace& workspace);

}  // namespace meshcontour::detail
