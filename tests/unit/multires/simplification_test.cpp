#include "meshcontour/simplification.hpp"

#include <numbers>

#include "meshcontour/cleaning.hpp"
#include "meshcontour/remeshing.hpp"
#include "multires/triangle_tree.hpp"
#include "support/catch.hpp"
#include "support/dirty_meshes.hpp"
#include "surfaces.hpp"

using namespace meshcontour;

namespace {

Shell simplified(Shell shell, SimplifyGoal goal, double value, unsigned threads = 1) {
  SimplifyOptions options;
  options.method = SimplifyMethod::Qem;
  options.goal = goal;
  options.value = value;
  options.threads = threads;
  simplify_shell(shell, options, static_cast<std::size_t>(value));
  return shell;
}

Shell sample_surface(int kind) {
  if (kind == 0) return surfaces::bumpy_sphere(3);
  if (kind == 1) return surfaces::shuffled(surfaces::bumpy_sphere(3), 7);
  if (kind == 2) return surfaces::height_field(16, true);
  return surfaces::shuffled(surfaces::height_field(20, true), 5);
}

}  // namespace

TEST_CASE("simplify_shell: loops lose vertices and nothing else, topology stays", "[multires]") {
  const Shell before = sample_surface(GENERATE(range(0, 4)));
  const double share = GENERATE(0.7, 0.3, 0.05);
  const Shell after = simplified(before, SimplifyGoal::Triangles, share * double(before.triangles.size()));
  CHECK(after.triangles.size() < before.triangles.size());
  const surfaces::Topology was = surfaces::topology_of(before), is = surfaces::topology_of(after);
  CHECK(is.manifold);
  CHECK(is.euler == was.euler);
  CHECK(surfaces::loops_thinned(before, after));
  for (const Patch& patch : after.patches) CHECK(patch.triangle_count > 0);
}

TEST_CASE("simplify_shell: the number of triangles is reached where nothing stands against it",
          "[multires]") {
  const Shell after = simplified(surfaces::bumpy_sphere(4), SimplifyGoal::Triangles, 300);
  CHECK(after.triangles.size() <= 300);
  CHECK(after.triangles.size() >= 298);
}

TEST_CASE("simplify_shell: the error asked for is kept", "[multires]") {
  const Shell before = sample_surface(GENERATE(range(0, 4)));
  const double error = GENERATE(0.03, 0.005);
  Shell after = before;
  SimplifyOptions options;
  options.method = SimplifyMethod::Qem;
  options.goal = SimplifyGoal::Error;
  options.value = error;
  const Simplification result = simplify_shell(after, options, 0);
  CHECK(result.error <= error);
  CHECK(result.triangles_after == after.triangles.size());
  const double sampled =
      std::max(surfaces::sampled_distance(before, after), surfaces::sampled_distance(after, before));
  CHECK(sampled <= result.error + 1e-12);
  CHECK(sampled >= 0.8 * result.error);
  if (error > 0.01) CHECK(after.triangles.size() < before.triangles.size() * 3 / 4);
}

TEST_CASE("simplify_shell: flat patches become as few triangles as their outline allows", "[multires]") {
  const Shell after = simplified(surfaces::height_field(16, false, 0), SimplifyGoal::Error, 1e-6);
  // Six corners of two rectangles, and the vertices at which their loops begin.
  CHECK(after.triangles.size() <= 8);
}

TEST_CASE("simplify_shell: the same bits for any number of threads", "[multires]") {
  const Shell before = surfaces::shuffled(surfaces::bumpy_sphere(4), 3);
  const Shell one = simplified(before, SimplifyGoal::Error, 0.01, 1),
              many = simplified(before, SimplifyGoal::Error, 0.01, 4);
  CHECK(one.points == many.points);
  CHECK(one.triangles == many.triangles);
}

TEST_CASE("simplify_shell: what is no manifold stays, and nothing breaks", "[multires][error]") {
  std::mt19937 random(11);
  for (int trial = 0; trial < 60; ++trial) {
    Shell before = dirty::soup(random, static_cast<Index>(4 + random() % 12), 3 + random() % 40);
    if (trial % 2 == 0)
      before = dirty::with_triangles(surfaces::octahedron(), {{0, 2, 1}, {0, 2, 4}, {1, 1, 3}});
    drop_unused_points(before);
    const Shell after = simplified(before, SimplifyGoal::Triangles, 1);
    CHECK(after.triangles.size() >= 1);
    CHECK(after.triangles.size() <= before.triangles.size());
    for (const Triangle& t : after.triangles) {
      for (const Index v : t) CHECK(v < after.points.size());
    }
  }
  const Shell fin = simplified(dirty::fin(), SimplifyGoal::Triangles, 1);
  CHECK(fin.triangles.size() == 3);
}

TEST_CASE("patch_distance: what can be told by hand", "[multires]") {
  const Shell flat = surfaces::height_field(8, false, 0);
  Shell moved = surfaces::height_field(5, false, 0);
  for (Point& p : moved.points) p.z() += 0.25;
  const SurfaceDistance apart = patch_distance(flat, flat);
  CHECK(apart.upper <= 1e-12);
  // The patches of the odd grid meet elsewhere: at 2/5 or 3/5 instead of 1/2.
  const SurfaceDistance d = patch_distance(flat, moved);
  const double expected = std::hypot(0.25, 0.1);
  CHECK(d.lower <= expected + 1e-12);
  CHECK(d.upper >= expected - 1e-12);
  CHECK(d.upper <= 1.03 * d.lower);
}

TEST_CASE("patch_distance: a dent between the corners is seen", "[multires]") {
  const Shell flat = surfaces::height_field(2, false, 0);
  Shell dented = surfaces::height_field(64, false, 0);
  dented.points[17 * 65 + 40].z() = 0.125;
  const SurfaceDistance d = patch_distance(flat, dented);
  CHECK(d.lower <= 0.125 + 1e-12);
  CHECK(d.upper >= 0.125 - 1e-12);
  CHECK(d.upper <= 0.13);
}

TEST_CASE("patch_distance: both halves of a triangle cut through a corner are seen", "[multires]") {
  // The one triangle is cut in the middle, through its tip; the other surface has a hole in one half.
  const double side = GENERATE(-1.0, 1.0);
  const Shell whole = surfaces::shell_of({{-1, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  std::vector<Point> points = {{-side, 0, 0}, {0, 0, 0}, {side, 0, 0}, {0, 1, 0}};
  const Point centre = (points[1] + points[2] + points[3]) / 3;
  for (std::size_t v = 1; v < 4; ++v) points.push_back((points[v] + centre) / 2);
  const Shell holed = surfaces::shell_of(
      points, {{0, 1, 3}, {1, 2, 5}, {1, 5, 4}, {2, 3, 6}, {2, 6, 5}, {3, 1, 4}, {3, 4, 6}});
  const SurfaceDistance d = patch_distance(whole, holed, 1);
  const double expected = (2 - std::sqrt(2.0)) / 4;  // the radius of the circle in the hole
  CHECK(d.lower <= expected + 1e-12);
  CHECK(d.upper >= expected - 1e-12);
  CHECK(d.upper <= 1.03 * expected);
}

TEST_CASE("TriangleTree: the nearest of long triangles askew is the nearest of all", "[multires][property]") {
  std::mt19937 random(5);
  const auto anywhere = [&] {
    const double x = surfaces::uniform(random), y = surfaces::uniform(random);
    return Point(x, y, surfaces::uniform(random));
  };
  const Point hub = anywhere();
  const Vector along = anywhere();
  std::vector<Point> points;
  std::vector<Triangle> triangles;
  for (Index i = 0; i < 500; ++i) {
    const Point start = i % 3 == 0 ? hub : anywhere(), end = i % 3 == 2 ? Point(start + along) : anywhere();
    points.insert(points.end(), {start, end, Point(end + 1e-3 * anywhere())});
    triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const detail::TriangleTree tree(points, triangles);
  for (int trial = 0; trial < 300; ++trial) {
    const Point p = trial == 0 ? hub : trial % 2 == 0 ? Point(hub + 1e-4 * anywhere()) : anywhere();
    double nearest = 1e300;
    for (const auto& [a, b, c] : triangles) {
      nearest =
          std::min(nearest, (detail::nearest_point({points[a], points[b], points[c]}, p) - p).squaredNorm());
    }
    CHECK(tree.nearest(p).squared == nearest);
  }
}

TEST_CASE("simplify_shell: a fan of many triangles around one vertex ends", "[multires]") {
  const Shell fan = surfaces::fan(20000);
  const Shell fewer = simplified(fan, SimplifyGoal::Triangles, 5000);
  CHECK(fewer.triangles.size() <= 5000);
  CHECK(patch_distance(fan, fewer, 1).upper <= 1e-6);
}

TEST_CASE("TriangleTree: among thousands of long triangles it looks at few", "[multires][property]") {
  const double height = GENERATE(0.0, 1.5);
  const Shell fan = surfaces::fan(10000, height), mesh = GENERATE(false, true) ? remeshed(fan).shell : fan;
  const detail::TriangleTree tree(mesh.points, mesh.triangles);
  std::mt19937 random(4);
  Index hint = 0;
  std::size_t looked_at = 0;
  constexpr std::size_t kTrials = 20000;
  for (std::size_t trial = 0; trial < kTrials; ++trial) {
    const double angle = 1e-3 * static_cast<double>(trial), share = 0.5 + surfaces::uniform(random) / 2;
    const Point p(share * std::cos(angle), share * std::sin(angle), (1 - share) * height);
    const detail::TriangleTree::Hit hit = tree.nearest(p, hint);
    CHECK(hit.triangle == tree.nearest(p).triangle);
    CHECK(hit.squared <= 1e-12);
    hint = hit.triangle;
    looked_at += hit.looked_at;
  }
  CHECK(looked_at <= 12 * kTrials);
}

TEST_CASE("patch_distance: corners that two fans share cost no more than others", "[multires]") {
  const Shell fan = surfaces::fan(20000, 1);
  const Remesh remesh = remeshed(fan);
  CHECK(remesh.error <= 1e-5);
  CHECK(remesh.flipped == 0);
}

TEST_CASE("patch_distance: slivers that rounding leaves between triangles end", "[multires]") {
  std::mt19937 random(1);
  const auto coordinate = [&] { return 100 * surfaces::uniform(random); };
  for (int trial = 0; trial < 3000; ++trial) {
    std::vector<Point> points;
    for (int k = 0; k < 3; ++k) {
      const double x = coordinate(), y = coordinate();
      points.push_back({x, y, coordinate()});
    }
    const Shell whole = surfaces::shell_of(points, {{0, 1, 2}});
    std::vector<Triangle> parts = {{0, 1, 2}};
    for (int cut = 0; cut < 8; ++cut) {
      const std::size_t i = random() % parts.size(), k = random() % 3;
      const Triangle t = parts[i];
      const double share = 0.5 + 0.45 * surfaces::uniform(random);
      const auto middle = static_cast<Index>(points.size());
      points.push_back((1 - share) * points[t[k]] + share * points[t[(k + 1) % 3]]);
      parts[i] = {t[k], middle, t[(k + 2) % 3]};
      parts.push_back({middle, t[(k + 1) % 3], t[(k + 2) % 3]});
    }
    CHECK(patch_distance(whole, surfaces::shell_of(points, parts), 1).upper <= 1e-4);
  }
}
