// Boundary edges and loops of any triangles against the plainest way to find them, and the two extractors
// compared.

#include <algorithm>
#include <string>

#include "fuzz/targets.hpp"
#include "meshcontour/boundary.hpp"
#include "support/brute_force.hpp"

namespace fuzz {
namespace {

using namespace meshcontour;

// A patch of up to 300 triangles on up to 66 vertices: the more vertices, the fewer chance encounters.
Model model_of(Bytes input) {
  Source source(input);
  const Index points = 3 + source.byte() % 64u;
  Shell shell;
  shell.id = "s";
  shell.points.assign(points, Point::Zero());
  while (!source.empty() && shell.triangles.size() < 300) {
    const Index a = source.byte() % points, b = source.byte() % points, c = source.byte() % points;
    shell.triangles.push_back({a, b, c});
  }
  shell.patches.push_back({"", {}, 0, shell.triangles.size()});
  Model model;
  model.shells.push_back(std::move(shell));
  return model;
}

std::vector<BoundaryEdge> undirected(std::vector<BoundaryEdge> edges) {
  for (BoundaryEdge& e : edges) e = {std::min(e.from, e.to), std::max(e.from, e.to)};
  std::ranges::sort(edges);
  return edges;
}

std::vector<BoundaryEdge> edges_along(const std::vector<BoundaryLoop>& loops) {
  std::vector<BoundaryEdge> edges;
  for (const BoundaryLoop& loop : loops) {
    const auto& v = loop.vertices;
    require(v.size() >= 2, "a loop of one vertex");
    for (std::size_t i = 0; i + 1 < v.size(); ++i) edges.push_back({v[i], v[i + 1]});
    if (loop.closed) edges.push_back({v.back(), v.front()});
  }
  return edges;
}

}  // namespace

void trace_loops(Bytes input) {
  const Model model = model_of(input);
  const auto& triangles = model.shells[0].triangles;
  const brute_force::Topology topology(triangles);
  const auto edges = sorted_boundary_edges(triangles);
  require(edges == topology.boundary(), "other boundary edges than by counting");
  const auto loops = meshcontour::trace_loops(triangles, edges);
  require(undirected(edges_along(loops)) == undirected(edges), "a boundary edge lost, or taken twice");
  const auto open = static_cast<std::size_t>(std::ranges::count(loops, false, &BoundaryLoop::closed));
  require(2 * open == topology.odd_vertices(), "chains left open without need");
  for (const PatchComparison& patch : compare_extractors(model, 1)) {
    require(!patch.disagrees(), "the extractors disagree on a manifold patch");
  }
}

}  // namespace fuzz
