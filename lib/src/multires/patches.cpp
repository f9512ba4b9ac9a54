#include "multires/patches.hpp"

#include <algorithm>

#include "meshcontour/boundary.hpp"

namespace meshcontour::detail {

std::vector<std::size_t> patch_of_triangles(const Shell& shell) {
  std::vector<std::size_t> patches(shell.triangles.size());
  for (std::size_t p = 0; p < shell.patches.size(); ++p) {
    std::fill_n(patches.begin() + static_cast<std::ptrdiff_t>(shell.patches[p].first_triangle),
                shell.patches[p].triangle_count, p);
  }
  return patches;
}

void mark_loop_starts(const Shell& shell, std::vector<bool>& marked) {
  for (std::size_t p = 0; p < shell.patches.size(); ++p) {
    const auto triangles = shell.patch_triangles(p);
    const std::vector<BoundaryEdge> edges = sorted_boundary_edges(triangles);
    for (const BoundaryLoop& loop : trace_loops(triangles, edges)) {
      marked[loop.vertices.front()] = true;
      if (!loop.closed) marked[loop.vertices.back()] = true;
    }
    for (std::size_t i = 1; i < edges.size(); ++i) {
      if (edges[i].from != edges[i - 1].from) continue;
      for (const Index v : {edges[i].from, edges[i].to, edges[i - 1].to}) marked[v] = true;
    }
  }
}

}  // namespace meshcontour::detail
