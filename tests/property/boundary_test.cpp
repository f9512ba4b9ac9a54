#include "meshcontour/boundary.hpp"

#include <algorithm>
#include <map>

#include "meshcontour/surface_mesh.hpp"
#include "support/brute_force.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace meshcontour;
using brute_force::Topology;

namespace {

BoundaryEdge undirected(Index a, Index b) {
  return {std::min(a, b), std::max(a, b)};
}

std::vector<BoundaryEdge> undirected(std::span<const BoundaryEdge> directed) {
  std::vector<BoundaryEdge> edges;
  for (const auto& [from, to] : directed) edges.push_back(undirected(from, to));
  std::ranges::sort(edges);
  return edges;
}

std::vector<BoundaryEdge> edges_along(const BoundaryLoop& loop) {
  std::vector<BoundaryEdge> edges;
  const auto& v = loop.vertices;
  for (std::size_t i = 0; i + 1 < v.size(); ++i) edges.push_back({v[i], v[i + 1]});
  if (loop.closed) edges.push_back({v.back(), v.front()});
  return edges;
}

std::vector<BoundaryEdge> edges_along(std::span<const BoundaryLoop> loops) {
  std::vector<BoundaryEdge> edges;
  for (const BoundaryLoop& loop : loops) std::ranges::copy(edges_along(loop), std::back_inserter(edges));
  return edges;
}

std::vector<Index> ends_of(std::span<const BoundaryEdge> edges) {
  std::set<Index> ends;
  for (const auto& [from, to] : edges) ends.insert({from, to});
  return {ends.begin(), ends.end()};
}

std::size_t open_chains(std::span<const BoundaryLoop> loops) {
  return static_cast<std::size_t>(std::ranges::count(loops, false, &BoundaryLoop::closed));
}

std::size_t places_where_a_loop_crosses(const BoundaryLoop& loop, const Topology& topology) {
  const auto edges = edges_along(loop);
  std::size_t crossings = 0;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (i + 1 == edges.size() && !loop.closed) break;
    const BoundaryEdge next = edges[(i + 1) % edges.size()];
    if (!topology.may_follow(edges[i].to, edges[i], next)) ++crossings;
  }
  return crossings;
}

// The smallest edge of a loop, as its triangle runs.
BoundaryEdge smallest(const BoundaryLoop& loop, const std::vector<BoundaryEdge>& boundary) {
  BoundaryEdge result{0xffffffff, 0xffffffff};
  for (const BoundaryEdge& e : edges_along(loop)) {
    const bool as_run = std::ranges::binary_search(boundary, e);
    result = std::min(result, as_run ? e : BoundaryEdge{e.to, e.from});
  }
  return result;
}

}  // namespace

TEST_CASE("meshes: what the generators say of their meshes is so", "[property][boundary]") {
  for (const meshes::Mesh& mesh : meshes::family()) {
    if (mesh.name.starts_with("soup")) continue;
    INFO(mesh.name);
    const Topology topology(mesh.triangles);
    CHECK(topology.manifold() == mesh.manifold);
    CHECK(topology.orientable() == mesh.orientable);
  }
}

TEST_CASE("sorted_boundary_edges: the edges that counting one by one finds", "[property][boundary]") {
  for (const meshes::Mesh& mesh : meshes::family()) {
    INFO(mesh.name);
    CHECK(sorted_boundary_edges(mesh.triangles) == Topology(mesh.triangles).boundary());
  }
}

TEST_CASE("trace_loops: every edge once, in one piece wherever an even number meets",
          "[property][boundary]") {
  for (const meshes::Mesh& mesh : meshes::family()) {
    INFO(mesh.name);
    const Topology topology(mesh.triangles);
    const auto edges = sorted_boundary_edges(mesh.triangles);
    const auto loops = trace_loops(mesh.triangles, edges);
    CHECK(undirected(edges_along(loops)) == undirected(edges));
    CHECK(2 * open_chains(loops) == topology.odd_vertices());
    if (mesh.loops) CHECK(loops.size() == *mesh.loops);
  }
}

TEST_CASE("trace_loops: no loop goes from one fan of triangles to another", "[property][boundary]") {
  for (const meshes::Mesh& mesh : meshes::family()) {
    INFO(mesh.name);
    const Topology topology(mesh.triangles);
    std::size_t crossings = 0;
    for (const BoundaryLoop& loop : trace_loops(mesh.triangles, sorted_boundary_edges(mesh.triangles))) {
      crossings += places_where_a_loop_crosses(loop, topology);
    }
    CHECK(crossings == 0);
  }
}

TEST_CASE("trace_loops: loops run as their triangles where these agree", "[property][boundary]") {
  for (const meshes::Mesh& mesh : meshes::family()) {
    const Topology topology(mesh.triangles);
    if (topology.edges_run_twice_the_same_way() > 0 || topology.edges_with_more_than_two() > 0) continue;
    INFO(mesh.name);
    const auto edges = sorted_boundary_edges(mesh.triangles);
    auto along = edges_along(trace_loops(mesh.triangles, edges));
    std::ranges::sort(along);
    CHECK(along == edges);
  }
}

TEST_CASE("trace_loops: loops come by their smallest edge, which they run forwards, first",
          "[property][boundary]") {
  for (const meshes::Mesh& mesh : meshes::family()) {
    INFO(mesh.name);
    const auto edges = sorted_boundary_edges(mesh.triangles);
    std::vector<BoundaryEdge> firsts;
    for (const BoundaryLoop& loop : trace_loops(mesh.triangles, edges)) {
      const BoundaryEdge first = smallest(loop, edges);
      const auto along = edges_along(loop);
      CHECK(std::ranges::count(along, first) == 1);
      if (loop.closed) CHECK(along[0] == first);
      firsts.push_back(first);
    }
    CHECK(std::ranges::is_sorted(firsts));
  }
}

TEST_CASE("extract_boundaries: Euler's formula gives the number of loops of a manifold",
          "[property][boundary]") {
  for (const meshes::Mesh& mesh : meshes::family()) {
    if (!mesh.manifold) continue;
    INFO(mesh.name);
    const auto loops = trace_loops(mesh.triangles, sorted_boundary_edges(mesh.triangles));
    CHECK(Topology(mesh.triangles).euler() + static_cast<int>(loops.size()) == mesh.closed_euler);
  }
}

TEST_CASE("extract_boundaries: counts of odd edges and vertices are those of counting one by one",
          "[property][boundary]") {
  std::vector<Diagnostic> diagnostics;
  for (const meshes::Mesh& mesh : meshes::family()) {
    INFO(mesh.name);
    const Topology topology(mesh.triangles);
    const auto boundary = extract_boundaries(meshes::model({mesh}), {}, diagnostics)[0].patches[0];
    std::map<Index, int> ends;
    for (const auto& [from, to] : boundary.edges) ++ends[from], ++ends[to];
    const bool is_exact =
        mesh.triangles.size() <= 200 || boundary.nonmanifold_edges + boundary.inconsistent_edges > 0;
    if (is_exact) CHECK(boundary.nonmanifold_edges == topology.edges_with_more_than_two());
    CHECK(boundary.inconsistent_edges == topology.edges_run_twice_the_same_way());
    CHECK(boundary.vertex_count == ends.size());
    const auto crowded = [](const auto& end) { return end.second > 2; };
    CHECK(boundary.touching_vertices == static_cast<std::size_t>(std::ranges::count_if(ends, crowded)));
  }
}

TEST_CASE("valence_boundary_vertices: the ends of the boundary edges of manifolds", "[property][boundary]") {
  for (const meshes::Mesh& mesh : meshes::family()) {
    if (!mesh.manifold) continue;
    INFO(mesh.name);
    CHECK(valence_boundary_vertices(mesh.triangles) == ends_of(sorted_boundary_edges(mesh.triangles)));
  }
}

TEST_CASE("compare_extractors: all methods agree on every orientable manifold", "[property][boundary]") {
  const auto family = meshes::family();
  const auto rows = compare_extractors(meshes::model(family));
  REQUIRE(rows.size() == family.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    INFO(family[i].name);
    const Topology topology(family[i].triangles);
    CHECK(rows[i].patch == i);
    CHECK(rows[i].manifold == (topology.manifold() && topology.orientable()));
    CHECK_FALSE(rows[i].disagrees());
    if (rows[i].manifold && !family[i].name.starts_with("soup")) CHECK(rows[i].unheld_triangles == 0);
  }
}

TEST_CASE("to_surface_mesh: holds or lists every triangle, and its border is that of those it holds",
          "[property][boundary]") {
  for (const meshes::Mesh& mesh : meshes::family()) {
    INFO(mesh.name);
    const Shell shell = meshes::shell(mesh);
    const HalfedgePatch patch = to_surface_mesh(shell, 0);
    CHECK(patch.mesh.number_of_faces() + patch.unheld.size() == mesh.triangles.size());
    std::vector<Triangle> held;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      if (!std::ranges::binary_search(patch.unheld, i)) held.push_back(mesh.triangles[i]);
    }
    std::vector<Diagnostic> diagnostics;
    const auto boundary =
        extract_boundaries(meshes::model({mesh}), {Extractor::Halfedge, 1}, diagnostics)[0].patches[0];
    CHECK(boundary.edges == Topology(held).boundary());
    CHECK(undirected(edges_along(boundary.loops)) == undirected(boundary.edges));
  }
}

TEST_CASE("extract_boundaries: the same for every number of threads", "[property][boundary]") {
  const Extractor extractor = GENERATE(Extractor::Sorted, Extractor::Halfedge);
  const Model model = meshes::model(meshes::family());
  std::vector<Diagnostic> one_diagnostic, more_diagnostics;
  const auto one = extract_boundaries(model, {extractor, 1}, one_diagnostic);
  const auto more = extract_boundaries(model, {extractor, 5}, more_diagnostics);
  for (std::size_t i = 0; i < one[0].patches.size(); ++i) {
    CHECK(one[0].patches[i].edges == more[0].patches[i].edges);
    CHECK(one[0].patches[i].loops == more[0].patches[i].loops);
  }
  REQUIRE(one_diagnostic.size() == more_diagnostics.size());
  for (std::size_t i = 0; i < one_diagnostic.size(); ++i)
    CHECK(one_diagnostic[i].text() == more_diagnostics[i].text());
}
