#pragma once

#include <span>
#include <vector>

#include "meshcontour/model.hpp"

namespace meshcontour::detail {

/// The opposite halfedge of each halfedge 3 f + k, which runs from corner k of triangle f to the next one;
/// 0xffffffff at a border. Linear but for the sort of the edges at each vertex.
///
/// @throws Error  BadData naming the vertices of an edge with three or more triangles or two that run along
///                it the same way, or of a degenerate triangle.
std::vector<Index> find_twins(std::span<const Triangle> triangles, Index vertex_count);

/// Says that something is not an orientable manifold.
///
/// @throws Error  BadData.
[[noreturn]] void refuse_as_manifold(const std::string& what);

}  // namespace meshcontour::detail
