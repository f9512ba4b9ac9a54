#include "multires/adaptive.hpp"

#include "meshcontour/simplification.hpp"
#include "multires/block_system.hpp"
#include "multires/surface_fit.hpp"
#include "multires/triangle_tree.hpp"
#include "support/catch.hpp"
#include "support/dirty_meshes.hpp"
#include "surfaces.hpp"

using namespace meshcontour;

namespace {

using detail::AdaptiveMesh;
using surfaces::uniform;

// A surface and its adaptive meshes.
struct Sample {
  Shell fine;
  SubdivisionConnectivity connectivity;
  std::vector<Point> points;  // in the order of the subdivision

  explicit Sample(Shell shell) : fine(std::move(shell)), connectivity(find_subdivision(fine)) {
    for (const Index v : connectivity.order) points.push_back(fine.points[v]);
  }

  AdaptiveMesh mesh() const { return mesh(points); }
  AdaptiveMesh mesh(const std::vector<Point>& moved) const {
    return {connectivity, moved, std::vector<bool>(points.size(), false)};
  }
};

Sample sample(int kind) {
  if (kind == 0) return Sample(surfaces::bumpy_sphere(4));
  Shell open = surfaces::height_field(4, false);
  open = subdivided(open, 3);
  for (Point& p : open.points) p.z() += 0.05 * std::sin(20 * p.x() * p.y());
  return Sample(std::move(open));
}

AdaptiveMesh::ActiveEdges random_set(const AdaptiveMesh& mesh, std::mt19937& random, double share) {
  AdaptiveMesh::ActiveEdges active;
  for (const auto& errors : mesh.errors()) {
    auto& level = active.emplace_back(errors.size());
    for (std::size_t e = 0; e < level.size(); ++e) level[e] = uniform(random) < 2 * share - 1;
  }
  mesh.close(active);
  return active;
}

std::vector<Triangle> triangles_of(const AdaptiveMesh& mesh, const AdaptiveMesh::ActiveEdges& active) {
  std::vector<std::size_t> first;
  std::vector<Triangle> triangles = mesh.triangles(active, first);
  CHECK(first.back() == triangles.size());
  return triangles;
}

// Of the distances of one surface's points to the other.
double root_mean_square(const Shell& from, const Shell& to) {
  const detail::TriangleTree tree(to.points, to.triangles);
  double sum = 0;
  for (const Point& p : from.points) sum += tree.nearest(p).squared;
  return std::sqrt(sum / double(from.points.size()));
}

}  // namespace

TEST_CASE("AdaptiveMesh: random sets are manifold, without cracks, of the same kind",
          "[multires][property]") {
  std::mt19937 random(3);
  for (int kind = 0; kind < 2; ++kind) {
    const Sample s = sample(kind);
    REQUIRE(s.connectivity.levels >= 3);
    const AdaptiveMesh mesh = s.mesh();
    const surfaces::Topology base = surfaces::topology_of(s.connectivity.base);
    const auto& finest = mesh.levels().back();
    std::size_t bad = 0;
    for (int trial = 0; trial < 500; ++trial) {
      const auto active = random_set(mesh, random, 0.002 + 0.1 * (uniform(random) + 1));
      Shell shell = surfaces::shell_of(s.points, triangles_of(mesh, active));
      const surfaces::Topology is = surfaces::topology_of(shell);
      bad += !is.manifold || is.euler != base.euler;
      // No T-vertex: an edge with one triangle lies on the border of the fine mesh.
      for (const ShellBoundary& boundary : surfaces::boundaries_of(shell)) {
        for (const BoundaryEdge& edge : boundary.patches[0].edges) {
          bad += finest.twins[finest.outgoing[edge.from]] != detail::MeshLevel::kNone;
          bad += finest.twins[finest.outgoing[edge.to]] != detail::MeshLevel::kNone;
        }
      }
      bad += is.border_edges > 0 && base.border_edges == 0;
    }
    CHECK(bad == 0);
  }
}

TEST_CASE("AdaptiveMesh: sets are closed and nested in the error, budgets are kept", "[multires][property]") {
  const Sample s = sample(GENERATE(0, 1));
  const AdaptiveMesh mesh = s.mesh();
  AdaptiveMesh::ActiveEdges finer;
  for (const double error : {1e-5, 1e-4, 1e-3, 1e-2, 1e-1}) {
    const auto active = mesh.edges_above(error);
    auto closed = active;
    mesh.close(closed);
    CHECK(closed == active);
    for (std::size_t j = 0; j < finer.size(); ++j) {
      for (std::size_t e = 0; e < active[j].size(); ++e) {
        if (active[j][e] && !finer[j][e]) FAIL("not nested");
      }
    }
    finer = active;
  }
  for (const std::size_t budget : {100u, 300u, 1000u}) {
    const std::size_t count = triangles_of(mesh, mesh.edges_above(mesh.error_for(budget))).size();
    CHECK(count <= budget);
    CHECK(count >= budget * 9 / 10 - 12);
  }
}

TEST_CASE("fit_to_surface: border curves are the same to the last bit whatever the inside is",
          "[multires][property]") {
  const Sample s = sample(GENERATE(0, 1));
  const AdaptiveMesh mesh = s.mesh();
  const auto& finest = mesh.levels().back();
  // The same details kept, of the surface and of one whose inside was moved at random.
  std::vector<std::size_t> first;
  Shell simple = surfaces::shell_of(s.points, mesh.triangles(mesh.edges_above(1e-3), first));
  Shell fine = surfaces::shell_of(s.points, finest.triangles);
  simple.patches = fine.patches = s.connectivity.base.patches;
  for (std::size_t p = 0; p < simple.patches.size(); ++p) {
    const Patch& base = s.connectivity.base.patches[p];
    const std::size_t end = base.first_triangle + base.triangle_count;
    simple.patches[p].first_triangle = first[base.first_triangle];
    simple.patches[p].triangle_count = first[end] - first[base.first_triangle];
    fine.patches[p].first_triangle <<= 2 * s.connectivity.levels;
    fine.patches[p].triangle_count <<= 2 * s.connectivity.levels;
  }
  Shell other = simple, other_fine = fine;
  std::mt19937 random(8);
  for (Index v = 0; v < s.points.size(); ++v) {
    if (finest.sharp_edges[v] > 0) continue;
    other_fine.points[v] += 0.1 * Point(uniform(random), uniform(random), uniform(random));
    other.points[v] = other_fine.points[v];
  }
  detail::fit_to_surface(simple, fine, 2, 1);
  detail::fit_to_surface(other, other_fine, 2, 1);
  bool inside_moved = false;
  for (Index v = 0; v < s.points.size(); ++v) {
    if (finest.sharp_edges[v] == 0) {
      inside_moved |= simple.points[v] != other.points[v];
    } else {
      CHECK(simple.points[v] == s.points[v]);
      CHECK(other.points[v] == s.points[v]);
    }
  }
  CHECK(inside_moved);
  const auto one = surfaces::boundaries_of(simple), two = surfaces::boundaries_of(other);
  for (std::size_t p = 0; p < simple.patches.size(); ++p) {
    REQUIRE(one[0].patches[p].loops.size() == two[0].patches[p].loops.size());
    for (std::size_t l = 0; l < one[0].patches[p].loops.size(); ++l)
      CHECK(one[0].patches[p].loops[l].vertices == two[0].patches[p].loops[l].vertices);
  }
}

TEST_CASE("fit_to_surface: nearer than before, border points and patches stay", "[multires][property]") {
  const Sample s = sample(GENERATE(0, 1));
  Shell before = s.fine;
  SimplifyOptions options;
  options.method = SimplifyMethod::Qem;
  options.goal = SimplifyGoal::Triangles;
  options.value = 1;
  simplify_shell(before, options, s.fine.triangles.size() / 10);
  Shell after = before;
  detail::fit_to_surface(after, s.fine, 3, 1);
  CHECK(root_mean_square(s.fine, after) < 0.95 * root_mean_square(s.fine, before));
  CHECK(surfaces::topology_of(after).manifold);
  CHECK(surfaces::topology_of(after).euler == surfaces::topology_of(before).euler);
  CHECK(surfaces::loops_thinned(before, after));
  CHECK(surfaces::loops_thinned(after, before));
  for (std::size_t p = 0; p < before.patches.size(); ++p)
    CHECK(after.patches[p].triangle_count == before.patches[p].triangle_count);
  Shell parallel = before;
  detail::fit_to_surface(parallel, s.fine, 3, 4);
  CHECK(parallel.points == after.points);
  CHECK(parallel.triangles == after.triangles);
}

TEST_CASE("fit_to_surface: a mesh that is the surface stays", "[multires]") {
  const Shell surface = sample(GENERATE(0, 1)).fine;
  Shell mesh = surface;
  detail::fit_to_surface(mesh, surface, 2, 1);
  CHECK(mesh.triangles == surface.triangles);
  double worst = 0;
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    worst = std::max(worst, (mesh.points[v] - surface.points[v]).norm());
  CHECK(worst <= 1e-12);
}

TEST_CASE("BlockSystem: nothing near has a smaller sum of squares, held vertices have no shift",
          "[multires]") {
  std::mt19937 random(4);
  const auto somewhere = [&] { return Vector(uniform(random), uniform(random), uniform(random)); };
  const std::vector<Triangle> triangles = {{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {4, 3, 5}};
  const std::vector<bool> free = {true, true, true, true, true, false};
  struct Row {
    Index triangle;
    Vector weights, rest;
    Eigen::Matrix3d metric;
  };
  std::vector<Row> rows;
  detail::BlockSystem system(triangles, free, 1e-9);
  for (Index i = 0; i < 60; ++i) {
    const double a = 0.5 + uniform(random) / 2, b = (1 - a) / 3;
    const Vector n = somewhere();
    const Row& row = rows.emplace_back(
        Row{i % 4, {a, b, 1 - a - b}, somewhere(), n * n.transpose() + 0.1 * Eigen::Matrix3d::Identity()});
    system.add(row.triangle, row.weights, row.metric, row.rest);
  }
  const auto sum = [&](const std::vector<Vector>& shifts) {
    double all = 0;
    for (const Row& row : rows) {
      Vector rest = row.rest;
      for (std::size_t k = 0; k < 3; ++k)
        rest -= row.weights[static_cast<Eigen::Index>(k)] * shifts[triangles[row.triangle][k]];
      all += rest.dot(row.metric * rest);
    }
    return all;
  };
  const std::vector<Vector> shifts = system.solve();
  CHECK(shifts[5].isZero(0));
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<Vector> other = shifts;
    for (std::size_t v = 0; v < 5; ++v) other[v] += 0.01 * somewhere();
    CHECK(sum(shifts) < sum(other));
  }
}

TEST_CASE("simplify_shell: wavelets keep loops and the error asked for", "[multires][property]") {
  Shell before = GENERATE(0, 1) == 0 ? surfaces::shuffled(surfaces::bumpy_sphere(4), 21) : sample(1).fine;
  Shell after = before;
  SimplifyOptions options;
  options.goal = SimplifyGoal::Error;
  options.value = GENERATE(0.05, 0.01);
  const Simplification result = simplify_shell(after, options, 0);
  CHECK(result.method == SimplifyMethod::Wavelet);
  CHECK(result.levels >= 3);
  CHECK(result.error <= options.value);
  CHECK(after.triangles.size() < before.triangles.size());
  CHECK(patch_distance(before, after).lower <= result.error);
  CHECK(surfaces::loops_thinned(before, after));
  CHECK(surfaces::topology_of(after).euler == surfaces::topology_of(before).euler);
  CHECK(surfaces::topology_of(after).manifold);
}

TEST_CASE("simplify_shell: wavelets are refused where there can be none", "[multires][error]") {
  Shell shell = dirty::fin();
  SimplifyOptions options;
  options.method = SimplifyMethod::Wavelet;
  options.goal = SimplifyGoal::Error;
  options.value = 0.1;
  CHECK_THROWS_WITH(simplify_shell(shell, options, 0), Catch::Contains("--simplify-method qem"));
}
