// Twins, refinement and detection of subdivision against what is found by looking at every edge.

#include <map>

#include "meshcontour/error.hpp"
#include "meshcontour/wavelet.hpp"
#include "multires/level.hpp"
#include "multires/twins.hpp"
#include "support/catch.hpp"
#include "surfaces.hpp"

using namespace meshcontour;

namespace {

using detail::MeshLevel;

Shell some_shell(int kind) {
  if (kind == 0) return surfaces::shuffled(surfaces::bumpy_sphere(2), 3);
  if (kind == 1) return surfaces::shuffled(surfaces::height_field(8, true), 5);
  return surfaces::octahedron();
}

// n x n squares of two triangles, left joined to right and top to bottom: all vertices are regular.
Shell torus(Index n) {
  std::vector<Point> points;
  std::vector<Triangle> triangles;
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) {
      const auto at = [n](Index row, Index column) { return row % n * n + column % n; };
      points.push_back({double(i), double(j), double(i * j % 7)});
      triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return surfaces::shell_of(std::move(points), std::move(triangles));
}

std::string refusal_of(std::vector<Triangle> triangles) {
  try {
    detail::make_level(triangles, 9, [](std::size_t, std::size_t) { return false; });
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::BadData);
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("find_twins: the halfedge with the same ends the other way round", "[multires][property]") {
  const Shell shell = some_shell(GENERATE(range(0, 3)));
  std::map<std::array<Index, 2>, Index> halfedges;
  const auto ends = [&](Index h) {
    const Triangle& t = shell.triangles[h / 3];
    return std::array<Index, 2>{t[h % 3], t[(h + 1) % 3]};
  };
  const std::vector<Index> twins =
      detail::find_twins(shell.triangles, static_cast<Index>(shell.points.size()));
  REQUIRE(twins.size() == 3 * shell.triangles.size());
  for (Index h = 0; h < twins.size(); ++h) halfedges[ends(h)] = h;
  for (Index h = 0; h < twins.size(); ++h) {
    const auto [from, to] = ends(h);
    const auto other = halfedges.find({to, from});
    CHECK(twins[h] == (other == halfedges.end() ? MeshLevel::kNone : other->second));
  }
}

TEST_CASE("make_level: what is no manifold is refused by name", "[multires][error]") {
  CHECK(refusal_of({{0, 1, 1}}) == "a triangle has vertex 1 twice: not an orientable manifold");
  CHECK(refusal_of({{2, 1, 2}}) == "a triangle has vertex 2 twice: not an orientable manifold");
  CHECK(refusal_of({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}) ==
        "edge 0-1 has 3 triangles: not an orientable manifold");
  CHECK(refusal_of({{0, 1, 2}, {0, 1, 3}}) ==
        "two triangles run along edge 0-1 the same way: not an orientable manifold");
  CHECK(refusal_of({{0, 1, 2}, {0, 3, 4}}) ==
        "several fans of triangles meet in vertex 0: not an orientable manifold");
  // Two tetrahedra that touch in vertex 0: both fans are closed.
  CHECK(
      refusal_of({{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}, {0, 4, 5}, {0, 5, 6}, {0, 6, 4}, {4, 6, 5}}) ==
      "several fans of triangles meet in vertex 0: not an orientable manifold");
  CHECK(refusal_of({{0, 1, 2}, {1, 0, 3}}).empty());
}

TEST_CASE("quadrisected: the level that its triangles give", "[multires][property]") {
  const Shell shell = some_shell(GENERATE(range(0, 3)));
  MeshLevel coarse = detail::make_level(shell);
  std::vector<std::size_t> patches;
  for (std::size_t p = 0; p < shell.patches.size(); ++p) {
    patches.insert(patches.end(), shell.patches[p].triangle_count, p);
  }
  for (unsigned step = 1; step <= 3; ++step) {
    const MeshLevel fine = detail::quadrisected(coarse);
    const MeshLevel made = detail::make_level(
        fine.triangles, fine.vertex_count,
        [&](std::size_t f, std::size_t g) { return patches[f >> 2 * step] != patches[g >> 2 * step]; });
    CHECK(detail::quadrisected_triangles(coarse) == fine.triangles);
    CHECK(fine.twins == made.twins);
    CHECK(fine.edges == made.edges);
    CHECK(fine.first_halfedge == made.first_halfedge);
    CHECK(fine.sharp == made.sharp);
    CHECK(fine.outgoing == made.outgoing);
    CHECK(fine.sharp_edges == made.sharp_edges);
    CHECK(fine.valences == made.valences);
    coarse = fine;
  }
}

TEST_CASE("find_subdivision: a mesh without irregular vertices is found, too", "[multires]") {
  const Shell base = torus(5);
  REQUIRE(find_subdivision(base).levels == 0);  // 50 triangles
  const SubdivisionConnectivity found = find_subdivision(surfaces::shuffled(subdivided(base, 2), 7));
  CHECK(found.levels == 2);
  CHECK(found.base.triangles.size() == base.triangles.size());
}

TEST_CASE("find_subdivision: no subdivision of a coarse mesh whose cut would close", "[multires]") {
  // The middle of an edge is there twice, so that a slit runs from one end of the edge to the other.
  Shell fine = subdivided(surfaces::octahedron(), 1);
  REQUIRE(find_subdivision(fine).levels == 1);
  const Index middle = fine.triangles[0][1];
  fine.points.push_back(fine.points[middle]);
  for (std::size_t t = 0; t < 4; ++t) {
    for (Index& v : fine.triangles[t]) v = v == middle ? static_cast<Index>(fine.points.size() - 1) : v;
  }
  CHECK(find_subdivision(fine).levels == 0);
}
