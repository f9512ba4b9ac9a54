#include <limits>
#include <utility>

#include "boundary/edge_filter.hpp"
#include "boundary/numbering.hpp"
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

}  // namespace

std::vector<Index> valence_boundary_vertices(std::span<const Triangle> patch) {
  const detail::Numbering numbering(patch);
  std::vector<Triangle> triangles = numbering.numbered(patch);
  std::erase_if(triangles, detail::degenerate);
  const CornersByVertex corners = group_corners(triangles, numbering.size());
  constexpr Index kNever = std::numeric_limits<Index>::max();
  std::vector<Index> seen_from(numbering.size(), kNever);
  std::vector<Index> boundary;
  for (Index v = 0; v < numbering.size(); ++v) {
    std::size_t neighbours = 0;
    for (std::size_t i = corners.first[v]; i < corners.first[v + 1]; ++i) {
      for (const Index u : triangles[corners.triangle[i]]) {
        if (u != v && std::exchange(seen_from[u], v) != v) ++neighbours;
      }
    }
    if (neighbours != corners.first[v + 1] - corners.first[v]) boundary.push_back(numbering.vertex(v));
  }
  return boundary;
}

}  // namespace meshcontour
