#pragma once

// The topology of a patch by the plainest means: the oracle of the boundary tests.

#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "meshcontour/boundary.hpp"

namespace brute_force {

using meshcontour::BoundaryEdge;
using meshcontour::Index;
using meshcontour::Triangle;

/// Triangles that repeat an index are left out.
class Topology {
 public:
  explicit Topology(std::span<const Triangle> triangles);

  /// Edges with one triangle, as it runs, sorted.
  std::vector<BoundaryEdge> boundary() const;

  std::size_t edges_with_more_than_two() const;

  /// Edges with two triangles that run the same way.
  std::size_t edges_run_twice_the_same_way() const;

  bool manifold() const;
  bool orientable() const;

  /// V - E + F over the vertices in use.
  int euler() const;

  /// Vertices with an odd number of boundary edges.
  std::size_t odd_vertices() const;

  /// Whether two boundary edges at a vertex bound the same fan, or fans that both end at an edge with more
  /// than two triangles.
  bool may_follow(Index vertex, BoundaryEdge a, BoundaryEdge b) const;

 private:
  using Corner = std::pair<Index, std::size_t>;  // vertex, triangle
  using Edge = std::pair<Index, Index>;          // smaller vertex first

  static Edge key(Index a, Index b) { return {std::min(a, b), std::max(a, b)}; }
  Corner fan_of(Corner corner) const;
  std::set<Corner> broken_fans(Index vertex) const;

  std::vector<Triangle> triangles_;
  std::map<Edge, std::vector<std::size_t>> edges_;  // to triangles
  std::map<Corner, Corner> parents_;                // fans: corners joined across edges with two triangles
};

}  // namespace brute_force
