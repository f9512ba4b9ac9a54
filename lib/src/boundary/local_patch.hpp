#pragma once

#include <span>
#include <vector>

#include "boundary/workspace.hpp"
#include "meshcontour/model.hpp"

namespace meshcontour::detail {

/// Some triangles over vertices of their own, numbered from 0 in the order of their first use.
struct LocalPatch {
  std::vector<Triangle> triangles;
  std::vector<Index> vertices;  ///< the number of each in the shell
};

/// Linear in the triangles. @param vertex_bound  above every index of the triangles.
LocalPatch number_locally(std::span<const Triangle> triangles, std::size_t vertex_bound,
                          ZeroedArray<Index>& slots);

/// Which triangles to turn over so that neighbours run alike where they can: those that run against most of
/// their component, or that would face the inside of a closed one.
std::vector<bool> turned_triangles(const Shell& shell, const LocalPatch& patch);

/// Whether the triangles form a surface: at most two on an edge, one fan at a vertex, and two sides. How they
/// run does not matter.
bool is_orientable_manifold(const Shell& shell, const LocalPatch& patch);

}  // namespace meshcontour::detail
