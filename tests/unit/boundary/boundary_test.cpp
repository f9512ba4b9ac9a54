#include "meshcontour/boundary.hpp"

#include <algorithm>
#include <numeric>

#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace meshcontour;

namespace {

std::vector<BoundaryLoop> loops_of(const std::vector<Triangle>& triangles) {
  return trace_loops(triangles, sorted_boundary_edges(triangles));
}

using Vertices = std::vector<Index>;

std::size_t open_chains(const std::vector<BoundaryLoop>& loops) {
  return static_cast<std::size_t>(std::ranges::count(loops, false, &BoundaryLoop::closed));
}

}  // namespace

TEST_CASE("sorted_boundary_edges: edges with one triangle, directed as it runs, in order", "[boundary]") {
  CHECK(sorted_boundary_edges(std::vector<Triangle>{{2, 0, 1}, {2, 1, 3}}) ==
        std::vector<BoundaryEdge>{{0, 1}, {1, 3}, {2, 0}, {3, 2}});
  CHECK(sorted_boundary_edges({}).empty());
}

TEST_CASE("sorted_boundary_edges: triangles that repeat an index are passed over", "[boundary]") {
  const std::vector<Triangle> triangles = {{0, 1, 2}, {0, 1, 1}, {2, 2, 2}, {2, 0, 2}};
  CHECK(sorted_boundary_edges(triangles) == std::vector<BoundaryEdge>{{0, 1}, {1, 2}, {2, 0}});
}

TEST_CASE("sorted_boundary_edges: indices may lie anywhere in 32 bits", "[boundary]") {
  constexpr Index kLast = 0xffffffff;
  const std::vector<Triangle> triangles = {{kLast, 7, 0x80000000}, {7, kLast, 3}};
  CHECK(sorted_boundary_edges(triangles) ==
        std::vector<BoundaryEdge>{{3, 7}, {7, 0x80000000}, {0x80000000, kLast}, {kLast, 3}});
  REQUIRE(loops_of(triangles).size() == 1);
  CHECK(loops_of(triangles)[0].vertices == Vertices{3, 7, 0x80000000, kLast});
}

TEST_CASE("trace_loops: a loop starts with its smallest edge and follows the triangles", "[boundary]") {
  const auto loops = loops_of({{9, 4, 6}, {3, 1, 2}});
  REQUIRE(loops.size() == 2);
  CHECK(loops[0].vertices == Vertices{1, 2, 3});
  CHECK(loops[1].vertices == Vertices{4, 6, 9});
  CHECK(loops[0].closed);
}

TEST_CASE("trace_loops: triangles that share one vertex keep loops of their own", "[boundary]") {
  const auto loops = loops_of(meshes::bow_tie(3).triangles);
  REQUIRE(loops.size() == 3);
  CHECK(loops[0].vertices == Vertices{0, 1, 2});
  CHECK(loops[1].vertices == Vertices{0, 3, 4});
  CHECK(loops[2].vertices == Vertices{0, 5, 6});
}

TEST_CASE("trace_loops: a hole that touches the outside is one loop through the vertex twice", "[boundary]") {
  const auto loops = loops_of(meshes::touching_hole().triangles);
  REQUIRE(loops.size() == 1);
  CHECK(loops[0].vertices == Vertices{0, 4, 7, 6, 5, 4, 1, 2, 3});
  CHECK(loops[0].closed);
}

TEST_CASE("trace_loops: a Moebius strip has one loop although its triangles disagree", "[boundary]") {
  const auto loops = loops_of(meshes::moebius(12).triangles);
  REQUIRE(loops.size() == 1);
  CHECK(loops[0].closed);
  CHECK(loops[0].vertices.size() == 24);
  CHECK(std::ranges::is_permutation(loops[0].vertices, [] {
    Vertices all(24);
    std::iota(all.begin(), all.end(), Index{0});
    return all;
  }()));
}

TEST_CASE("trace_loops: a fin on an edge leaves a loop and an open chain", "[boundary]") {
  const auto loops = loops_of(meshes::fin(3).triangles);
  REQUIRE(loops.size() == 2);
  CHECK(loops[0].vertices == Vertices{0, 3, 1, 2});
  CHECK(loops[0].closed);
  CHECK(loops[1].vertices == Vertices{1, 4, 0});
  CHECK_FALSE(loops[1].closed);
}

TEST_CASE("trace_loops: an even number of fins closes all loops", "[boundary]") {
  const Index fins = GENERATE(2, 4, 6, 100);
  const auto loops = loops_of(meshes::fin(fins).triangles);
  CHECK(loops.size() == fins / 2);
  CHECK(open_chains(loops) == 0);
}

TEST_CASE("extract_boundaries: patches share points, and each has its own boundary", "[boundary]") {
  const Model model =
      meshes::model({meshes::grid(20, 20, 2), meshes::disc(4), meshes::sphere(8, 4), meshes::soup(9, 0, 1)});
  std::vector<Diagnostic> diagnostics;
  const auto boundaries = extract_boundaries(model, {}, diagnostics);
  REQUIRE(boundaries.size() == 1);
  const auto& patches = boundaries[0].patches;
  REQUIRE(patches.size() == 4);
  CHECK(patches[0].loops.size() == 26);
  CHECK(patches[0].vertex_count == 80 + 25 * 4);
  CHECK(patches[1].loops.size() == 1);
  CHECK(patches[1].edges == std::vector<BoundaryEdge>{{1, 2}, {2, 3}, {3, 4}, {4, 1}});
  CHECK(patches[2].loops.empty());
  CHECK(patches[3].edges.empty());
  CHECK(diagnostics.empty());
}

TEST_CASE("extract_boundaries: findings are counted a shell, with the first patch named", "[boundary]") {
  const Model model = meshes::model(
      {meshes::disc(4), meshes::fin(3), meshes::fin(5), meshes::moebius(12), meshes::bow_tie(2)});
  std::vector<Diagnostic> diagnostics;
  const auto boundaries = extract_boundaries(model, {}, diagnostics);
  REQUIRE(diagnostics.size() == 4);
  CHECK(diagnostics[0].message == "boundary chain does not close");
  CHECK(diagnostics[0].count == 2);
  CHECK(diagnostics[0].spot.element == "shell generated, patch 2");
  CHECK(diagnostics[1].message == "edge with three or more triangles in its patch");
  CHECK(diagnostics[1].count == 2);
  CHECK(diagnostics[2].message == "edge whose two triangles run the same way");
  CHECK(diagnostics[2].spot.element == "shell generated, patch 4");
  CHECK(diagnostics[3].message == "vertex at which boundary loops touch");
  CHECK(boundaries[0].patches[3].inconsistent_edges == diagnostics[2].count);
}

TEST_CASE("valence_boundary_vertices: on manifolds these are the ends of the boundary edges", "[boundary]") {
  CHECK(valence_boundary_vertices(meshes::disc(5).triangles) == Vertices{1, 2, 3, 4, 5});
  CHECK(valence_boundary_vertices(meshes::sphere(6, 3).triangles).empty());
  CHECK(valence_boundary_vertices(meshes::pinched_tube(4).triangles) == Vertices{1, 2, 3, 4, 5, 6, 7, 8});
}
