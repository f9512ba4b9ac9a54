#include <algorithm>
#include <limits>
#include <utility>

#include "boundary/edge_filter.hpp"
#include "boundary/local_patch.hpp"
#include "boundary/numbering.hpp"
#include "boundary/valence.hpp"
#include "meshcontour/boundary.hpp"

namespace meshcontour {
namespace {

// The corners of the triangles, grouped by vertex.
struct CornersByVertex {
  std::vector<std::size_t> first;  // of vertex v: [first[v], first[v + 1])
  std::vector<std::size_t> triangle;
};

CornersByVertex group_corners(std::span<const Triangle> triangles, std::size_t vertices) {
  CornersByVertex corners{std::vector<std::size_t>(vertices + 2), {}};
  for (const Triangle& t : triangles) {
    for (const Index v : t) ++corners.first[v + 2];
  }
  for (std::size_t v = 2; v < corners.first.size(); ++v) corners.first[v] += corners.first[v - 1];
  corners.triangle.resize(3 * triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (const Index v : triangles[i]) corners.triangle[corners.first[v + 1]++] = i;
  }
  return corners;
}

// Positions in patch.vertices of the vertices with another number of neighbours than of triangles.
std::vector<Index> uneven_vertices(const detail::LocalPatch& patch) {
  std::vector<Triangle> triangles;
  std::ranges::remove_copy_if(patch.triangles, std::back_inserter(triangles), detail::degenerate);
  const CornersByVertex corners = group_corners(triangles, patch.vertices.size());
  constexpr Index kNever = std::numeric_limits<Index>::max();
  std::vector<Index> seen_from(patch.vertices.size(), kNever);
  std::vector<Index> uneven;
  for (Index v = 0; v < patch.vertices.size(); ++v) {
    std::size_t neighbours = 0;
    for (std::size_t i = corners.first[v]; i < corners.first[v + 1]; ++i) {
      for (const Index u : triangles[corners.triangle[i]]) {
        if (u != v && std::exchange(seen_from[u], v) != v) ++neighbours;
      }
    }
    if (neighbours != corners.first[v + 1] - corners.first[v]) uneven.push_back(v);
  }
  return uneven;
}

}  // namespace

std::vector<Index> detail::valence_boundary_vertices(std::span<const Triangle> triangles,
                                                     std::size_t vertex_bound, Workspace& workspace) {
  const LocalPatch patch = number_locally(triangles, vertex_bound, workspace.slots);
  std::vector<Index> boundary = uneven_vertices(patch);
  for (Index& v : boundary) v = patch.vertices[v];
  std::ranges::sort(boundary);
  return boundary;
}

std::vector<Index> valence_boundary_vertices(std::span<const Triangle> triangles) {
  detail::Workspace workspace;
  const std::size_t bound = detail::vertex_bound(triangles);
  if (detail::is_dense(bound, triangles.size())) {
    return detail::valence_boundary_vertices(triangles, bound, workspace);
  }
  const detail::Numbering numbering(triangles);
  auto boundary =
      detail::valence_boundary_vertices(numbering.numbered(triangles), numbering.size(), workspace);
  for (Index& v : boundary) v = numbering.vertex(v);
  return boundary;
}

}  // namespace meshcontour
