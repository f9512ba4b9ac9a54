#pragma once

#include <span>
#include <vector>

#include "boundary/workspace.hpp"

namespace meshcontour::detail {

/// meshcontour::valence_boundary_vertices for indices below `vertex_bound`.
std::vector<Index> valence_boundary_vertices(std::span<const Triangle> triangles, std::size_t vertex_bound,
                                             Workspace& workspace);

}  // namespace meshcontour::detail
