#include "meshcontour/boundary.hpp"

#include "boundary/edge_filter.hpp"
#include "boundary/loops.hpp"
#include "boundary/numbering.hpp"

namespace meshcontour {

std::vector<BoundaryEdge> sorted_boundary_edges(std::span<const Triangle> triangles) {
  detail::Workspace workspace;
  const std::size_t bound = detail::vertex_bound(triangles);
  if (detail::is_dense(bound, triangles.size())) {
    return detail::census_of_edges(triangles, bound, workspace).boundary;
  }
  const detail::Numbering numbering(triangles);
  auto edges = detail::census_of_edges(numbering.numbered(triangles), numbering.size(), workspace).boundary;
  for (auto& [from, to] : edges) {
    from = numbering.vertex(from);
    to = numbering.vertex(to);
  }
  return edges;
}

std::vector<BoundaryLoop> trace_loops(std::span<const Triangle> triangles,
                                      std::span<const BoundaryEdge> edges) {
  detail::Workspace workspace;
  const std::size_t bound = detail::vertex_bound(triangles);
  if (detail::is_dense(bound, triangles.size())) {
    return detail::trace_loops(triangles, edges, bound, workspace).loops;
  }
  const detail::Numbering numbering(triangles);
  std::vector<BoundaryEdge> numbered(edges.begin(), edges.end());
  for (auto& [from, to] : numbered) {
    from = numbering.number(from);
    to = numbering.number(to);
  }
  auto loops =
      detail::trace_loops(numbering.numbered(triangles), numbered, numbering.size(), workspace).loops;
  for (BoundaryLoop& loop : loops) {
    std::vector<Index> vertices(loop.vertices.begin(), loop.vertices.end());
    for (Index& v : vertices) v = numbering.vertex(v);
    loop.vertices = std::move(vertices);
  }
  return loops;
}

}  // namespace meshcontour
