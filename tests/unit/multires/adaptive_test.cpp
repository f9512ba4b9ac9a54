#include "multires/adaptive.hpp"

#include "meshcontour/simplification.hpp"
#include "support/catch.hpp"
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

TEST_CASE("AdaptiveMesh: sharp edges do not move when the inside does", "[multires][property]") {
  const Sample s = sample(GENERATE(0, 1));
  const AdaptiveMesh mesh = s.mesh();
  const auto active = mesh.edges_above(1e-3);
  const std::vector<Point> fitted = mesh.fitted(active);
  const auto& finest = mesh.levels().back();
  std::mt19937 random(8);
  std::vector<Point> moved = s.points;
  for (Index v = 0; v < moved.size(); ++v) {
    if (finest.sharp_edges[v] == 0)
      moved[v] += 0.1 * Point(uniform(random), uniform(random), uniform(random));
  }
  const std::vector<Point> other = s.mesh(moved).fitted(active);
  bool inside_moved = false;
  for (const Triangle& t : triangles_of(mesh, active)) {
    for (const Index v : t) {
      if (finest.sharp_edges[v] > 0) {
        CHECK(fitted[v] == other[v]);
        CHECK(fitted[v] == s.points[v]);
      } else {
        inside_moved |= fitted[v] != other[v];
      }
    }
  }
  CHECK(inside_moved);
}

TEST_CASE("AdaptiveMesh: with every edge active there is nothing to fit", "[multires]") {
  const Sample s = sample(1);
  const AdaptiveMesh mesh = s.mesh();
  const std::vector<Point> same = mesh.fitted(mesh.edges_above(0));
  double worst = 0;
  for (std::size_t v = 0; v < same.size(); ++v) worst = std::max(worst, (same[v] - s.points[v]).norm());
  CHECK(worst <= 1e-9);
}

TEST_CASE("fit_vertices: nothing near has a smaller sum of squares, fixed points stay", "[multires]") {
  std::mt19937 random(4);
  const auto somewhere = [&] { return Point(uniform(random), uniform(random), uniform(random)); };
  // Ten vertices, the last two fixed, and forty points on random triangles of them.
  std::vector<Point> points;
  std::vector<detail::VertexMean> means;
  std::vector<double> shares;
  std::vector<bool> fixed(50, false);
  fixed[8] = fixed[9] = true;
  for (Index i = 0; i < 50; ++i) {
    points.push_back(somewhere());
    shares.push_back(1.5 + uniform(random));
    detail::VertexMean mean{{i, i, i}, {1, 0, 0}};
    if (i >= 10) {
      const double a = 0.5 + uniform(random) / 2, b = (1 - a) / 2;
      mean = {{i % 10, (i + 3) % 10, (i + 7) % 10}, {a, b, 1 - a - b}};
    }
    means.push_back(mean);
  }
  const auto sum = [&](const std::vector<Point>& vertices) {
    double all = 0;
    for (std::size_t i = 0; i < means.size(); ++i) {
      Point at = Point::Zero();
      for (std::size_t k = 0; k < 3; ++k) at += means[i].weights[k] * vertices[means[i].vertices[k]];
      all += shares[i] * (at - points[i]).squaredNorm();
    }
    return all;
  };
  const std::vector<Point> fitted = detail::fit_vertices(means, shares, fixed, points);
  CHECK(fitted[8] == points[8]);
  CHECK(fitted[9] == points[9]);
  CHECK(sum(fitted) < 0.9 * sum(points));
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<Point> other = fitted;
    for (std::size_t v = 0; v < 8; ++v) other[v] += 0.01 * somewhere();
    CHECK(sum(fitted) < sum(other));
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

TEST_CASE("simplify_shell: wavelets are refused where there are none", "[multires][error]") {
  Shell shell = surfaces::height_field(5, false);
  SimplifyOptions options;
  options.method = SimplifyMethod::Wavelet;
  options.goal = SimplifyGoal::Error;
  options.value = 0.1;
  CHECK_THROWS_WITH(simplify_shell(shell, options, 0), Catch::Contains("--simplify-method qem"));
}
