// What must hold of subdivision and of the lifted transform, whatever the mesh.

#include "meshcontour/wavelet.hpp"

#include <Eigen/Eigenvalues>
#include <numbers>

#include "multires/level.hpp"
#include "multires/stencil.hpp"
#include "support/catch.hpp"
#include "surfaces.hpp"

using namespace meshcontour;

namespace {

using detail::MeshLevel;
using surfaces::uniform;

// A vertex of valence k in the middle of `rings` rings of regular ones.
Shell rings_around(Index k, Index rings) {
  std::vector<Point> points = {Point::Zero()};
  const auto at = [&](Index ring, Index i) {
    return ring == 0 ? 0 : 1 + k * ring * (ring - 1) / 2 + i % (k * ring);
  };
  for (Index r = 1; r <= rings; ++r) {
    for (Index i = 0; i < k * r; ++i) {
      const double angle = 2 * std::numbers::pi * i / (k * r);
      points.push_back({r * std::cos(angle), r * std::sin(angle), 0});
    }
  }
  std::vector<Triangle> triangles;
  for (Index r = 1; r <= rings; ++r) {
    for (Index side = 0; side < k; ++side) {
      for (Index i = 0; i < r; ++i) {
        const Index inner = side * (r - 1) + i, outer = side * r + i;
        triangles.push_back({at(r - 1, inner), at(r, outer), at(r, outer + 1)});
        if (i + 1 < r) triangles.push_back({at(r - 1, inner), at(r, outer + 1), at(r - 1, inner + 1)});
      }
    }
  }
  return surfaces::shell_of(std::move(points), std::move(triangles));
}

// Two tips, each joined to all of k points between them.
Shell bipyramid(Index k) {
  std::vector<Point> points = {{0, 0, 1}, {0, 0, -1}};
  std::vector<Triangle> triangles;
  for (Index i = 0; i < k; ++i) {
    const double angle = 2 * std::numbers::pi * i / k;
    points.push_back({std::cos(angle), std::sin(angle), 0});
    const Index here = 2 + i, next = 2 + (i + 1) % k;
    triangles.insert(triangles.end(), {{0, here, next}, {1, next, here}});
  }
  return surfaces::shell_of(std::move(points), std::move(triangles));
}

// A regular lattice: n x n squares of two triangles, points sheared so that triangles are alike.
Shell lattice(Index n) {
  Shell shell = surfaces::height_field(n, false, 0);
  shell.patches = {{"", {}, 0, shell.triangles.size()}};
  for (Point& p : shell.points) p = Point(p.x() + p.y() / 2, p.y(), 0);
  return shell;
}

double largest(const std::vector<Point>& points) {
  double size = 0;
  for (const Point& p : points) size = std::max(size, p.cwiseAbs().maxCoeff());
  return size;
}

double apart(const std::vector<Point>& a, const std::vector<Point>& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, (a[i] - b[i]).norm());
  return worst;
}

Shell some_base(int kind) {
  if (kind == 0) return surfaces::octahedron();
  if (kind == 1) return rings_around(7, 2);
  if (kind == 2) return surfaces::height_field(4, true);
  if (kind == 4) return rings_around(100, 1);
  if (kind == 5) return bipyramid(100);
  return surfaces::bumpy_sphere(1);
}

Point mean_of(const std::vector<Point>& points, std::span<const double> integrals) {
  Point sum = Point::Zero();
  double all = 0;
  for (std::size_t v = 0; v < integrals.size(); ++v) {
    sum += integrals[v] * points[v];
    all += integrals[v];
  }
  return sum / all;
}

}  // namespace

TEST_CASE("subdivided: the local spectrum is 1, 1/2, 1/2, 1/4", "[multires][property]") {
  const Index valence = GENERATE(range(3u, 17u));
  // Three rings determine three rings of half the size; the matrix maps the values on one to those on the
  // other.
  const Shell coarse = rings_around(valence, 4);
  const Shell fine = subdivided(coarse, 1);
  const std::size_t size = 1 + 6 * valence;  // vertices of three rings
  const MeshLevel level = detail::make_level(fine.triangles, static_cast<Index>(fine.points.size()),
                                             [](std::size_t, std::size_t) { return false; });
  const MeshLevel start = detail::make_level(coarse.triangles, static_cast<Index>(coarse.points.size()),
                                             [](std::size_t, std::size_t) { return false; });
  // The same place in both: they are walked through at once, from the middle.
  std::vector<Index> partner(coarse.points.size(), MeshLevel::kNone);
  std::vector<std::pair<Index, Index>> queue = {{start.outgoing[0], level.outgoing[0]}};
  std::vector<bool> seen(start.twins.size(), false);
  while (!queue.empty()) {
    auto [h, g] = queue.back();
    queue.pop_back();
    if (seen[h]) continue;
    for (int k = 0; k < 3; ++k, h = MeshLevel::next(h), g = MeshLevel::next(g)) {
      seen[h] = true;
      partner[start.start(h)] = level.start(g);
      const Index across = start.twins[h], other = level.twins[g];
      if (across != MeshLevel::kNone && other != MeshLevel::kNone) queue.emplace_back(across, other);
    }
  }
  Eigen::MatrixXd matrix(size, size);
  for (std::size_t column = 0; column < size; ++column) {
    Shell unit = coarse;
    for (Point& p : unit.points) p = Point::Zero();
    unit.points[column].x() = 1;
    const Shell image_of_unit = subdivided(unit, 1);
    for (std::size_t row = 0; row < size; ++row) {
      matrix(Eigen::Index(row), Eigen::Index(column)) = image_of_unit.points[partner[row]].x();
    }
  }
  Eigen::VectorXd moduli = matrix.eigenvalues().cwiseAbs();
  std::sort(moduli.begin(), moduli.end(), std::greater{});
  CHECK(moduli[0] == Approx(1).margin(1e-10));
  CHECK(moduli[1] == Approx(0.5).margin(1e-10));
  CHECK(moduli[2] == Approx(0.5).margin(1e-10));
  CHECK(moduli[3] == Approx(0.25).margin(1e-8));
}

TEST_CASE("subdivided: cubics are kept inside regular lattices, linear functions everywhere",
          "[multires][property]") {
  std::mt19937 random(1);
  const Index n = 12;
  Shell shell = lattice(n);
  const std::vector<Point> places = shell.points;
  std::array<double, 10> c{};
  for (double& x : c) x = uniform(random);
  const auto cubic = [&](double x, double y) {
    return c[0] + c[1] * x + c[2] * y + c[3] * x * x + c[4] * x * y + c[5] * y * y + c[6] * x * x * x +
           c[7] * x * x * y + c[8] * x * y * y + c[9] * y * y * y;
  };
  for (Point& p : shell.points) p.z() = cubic(p.x(), p.y());
  const Shell fine = subdivided(shell, 1);
  double worst_cubic = 0, worst_linear = 0;
  for (const Point& p : fine.points) {
    const double v = p.y() * n, u = (p.x() - p.y() / 2) * n;
    const bool inside = u > 2.1 && u < n - 2.1 && v > 2.1 && v < n - 2.1;
    if (inside) worst_cubic = std::max(worst_cubic, std::abs(p.z() - cubic(p.x(), p.y())));
  }
  CHECK(worst_cubic <= 1e-13);
  for (Point& p : shell.points) p.z() = 3 * p.x() - 2 * p.y() + 1;
  for (const Point& p : subdivided(shell, 2).points) {
    worst_linear = std::max(worst_linear, std::abs(p.z() - (3 * p.x() - 2 * p.y() + 1)));
  }
  CHECK(worst_linear <= 1e-13);
}

TEST_CASE("subdivided: the rule of a vertex with hundreds of edges is that of the others", "[multires]") {
  const Index valence = GENERATE(65u, 300u);
  Shell shell = rings_around(valence, 2);
  std::mt19937 random(3);
  for (Point& p : shell.points) p += 0.3 * Point(uniform(random), uniform(random), uniform(random));
  const Shell fine = subdivided(shell, 1);
  const std::vector<double> weights = butterfly_weights(valence);
  const MeshLevel level = detail::make_level(shell);
  for (Index h = 0; h < level.twins.size(); ++h) {
    if (level.start(h) != 0) continue;
    Point expected = 0.75 * shell.points[0];
    Index spoke = h;
    for (const double weight : weights) {
      expected += weight * shell.points[level.end(spoke)];
      spoke = level.twins[MeshLevel::previous(spoke)];
    }
    CHECK((fine.points[level.vertex_count + level.edges[h]] - expected).norm() <= 1e-14);
  }
}

TEST_CASE("subdivided: a border vertex of hundreds of triangles follows the trigonometric rule",
          "[multires][property]") {
  const Index triangles = GENERATE(40u, 64u, 65u, 400u);
  Shell shell = surfaces::corner_fan(triangles);
  std::mt19937 random(7);
  for (Point& p : shell.points) p += 0.3 * Point(uniform(random), uniform(random), uniform(random));
  const Shell fine = subdivided(shell, 1, {.boundary = BoundaryRule::Trigonometric});
  const MeshLevel level = detail::make_level(shell);
  const double n = triangles, theta = std::numbers::pi / n;
  for (Index h = 0; h < level.twins.size(); ++h) {
    // The rule of the other end, with two triangles, has the other half.
    if (level.start(h) != 0 || level.across(h) == MeshLevel::kNone) continue;
    const double at = (level.end(h) - 1) * theta;
    const double end = std::cos(at) / 4 - std::sin(2 * theta) * std::sin(2 * at) /
                                              (4 * n * (std::cos(theta) - std::cos(2 * theta)));
    Point expected = (1 - std::sin(theta) * std::sin(at) / (n * (1 - std::cos(theta)))) * shell.points[0] +
                     end * (shell.points[1] - shell.points[triangles + 1]);
    for (Index j = 1; j < triangles; ++j) {
      expected += (std::sin(at) * std::sin(j * theta) + std::sin(2 * at) * std::sin(2 * j * theta) / 2) / n *
                  shell.points[j + 1];
    }
    const Point other = (shell.points[0] + shell.points[level.end(h)]) / 2;
    CHECK((fine.points[level.vertex_count + level.edges[h]] - (expected + other) / 2).norm() <= 1e-13);
  }
}

TEST_CASE("Stencils: all together are as large as the mesh, whatever the valences", "[multires]") {
  const Shell shell = GENERATE(surfaces::fan(50000), surfaces::corner_fan(50000));
  const MeshLevel level = detail::make_level(shell);
  const detail::Stencils stencils(level, GENERATE(BoundaryRule::Reflect, BoundaryRule::Trigonometric));
  std::vector<detail::Stencils::Term> terms;
  std::size_t all = 0;
  for (Index e = 0; e < level.edge_count(); ++e) {
    stencils.of_edge(e, terms);
    all += terms.size();
  }
  CHECK(all <= 70 * level.edge_count());
}

TEST_CASE("WaveletTransform: around border vertices of many triangles details come back, the mean stays",
          "[multires][property]") {
  const Shell base = surfaces::corner_fan(GENERATE(30u, 200u));
  const WaveletTransform transform(base, 2, {.boundary = BoundaryRule::Trigonometric});
  std::mt19937 random(11);
  std::vector<Point> points(transform.vertex_count(2));
  for (Point& p : points) p = Point(uniform(random), uniform(random), uniform(random));
  const std::vector<Point> given = points;
  transform.synthesise(points);
  const std::vector<Point> fine = points;
  transform.analyse(points);
  CHECK(apart(points, given) <= 1e-12 * largest(fine));
  // Integrals are the transpose of the rule: that of the constant 1 stays, and of any coarse surface too.
  std::fill(points.begin() + transform.vertex_count(0), points.end(), Point::Zero());
  const std::vector<Point> coarse = points;
  transform.synthesise(points);
  CHECK((mean_of(coarse, transform.integrals(0)) - mean_of(points, transform.integrals(2))).norm() <=
        1e-12 * largest(points));
}

TEST_CASE("WaveletTransform: random details come back, the mean stays", "[multires][property]") {
  const int kind = GENERATE(range(0, 6));
  const unsigned levels = kind == 0 ? 8 : 4;
  const Shell base = some_base(kind);
  const WaveletTransform transform(base, levels);
  std::mt19937 random(static_cast<unsigned>(kind));
  std::vector<Point> points(transform.vertex_count(levels));
  for (Point& p : points) p = Point(uniform(random), uniform(random), uniform(random));
  const std::vector<Point> given = points;
  transform.synthesise(points);
  const double size = largest(points);
  const std::vector<Point> fine = points;
  transform.analyse(points);
  CHECK(apart(points, given) <= 1e-12 * size);
  if (transform.unlifted() == 0) {
    const Point coarse = mean_of(points, transform.integrals(0)),
                finest = mean_of(fine, transform.integrals(levels));
    CHECK((coarse - finest).norm() <= 1e-12 * size);
  }
}

TEST_CASE("WaveletTransform: a subdivided mesh has no details", "[multires][property]") {
  const Shell base = some_base(GENERATE(range(0, 6)));
  const WaveletTransform transform(base, 3);
  std::vector<Point> points = subdivided(base, 3).points;
  const double size = largest(points);
  transform.analyse(points);
  for (std::size_t v = base.points.size(); v < points.size(); ++v) CHECK(points[v].norm() <= 1e-13 * size);
}

TEST_CASE("WaveletTransform: the same bits for any number of threads", "[multires][property]") {
  const Shell base = surfaces::bumpy_sphere(1);
  std::vector<Point> points = surfaces::bumpy_sphere(5, 0.3).points;
  std::vector<Point> one = points, many = points;
  WaveletTransform(base, 4, {.threads = 1}).analyse(one);
  WaveletTransform(base, 4, {.threads = 4}).analyse(many);
  CHECK(one == many);
}

TEST_CASE("find_subdivision: a shuffled subdivision is found and put in order", "[multires][property]") {
  const int kind = GENERATE(range(0, 4));
  const unsigned levels = GENERATE(1u, 3u);
  const Shell base = some_base(kind);
  const Shell fine = subdivided(base, levels), mixed = surfaces::shuffled(fine, 17);
  const SubdivisionConnectivity found = find_subdivision(mixed);
  REQUIRE(found.levels >= levels);
  const Shell again = subdivided(found.base, found.levels);
  REQUIRE(again.triangles.size() == mixed.triangles.size());
  REQUIRE(found.order.size() == mixed.points.size());
  for (std::size_t p = 0; p < mixed.patches.size(); ++p) {
    // Each triangle as the three vertices of the shuffled shell, the smallest first.
    const auto triangles = [&](const Shell& shell, const auto& name) {
      std::set<Triangle> out;
      for (const Triangle& t : shell.patch_triangles(p)) {
        Triangle u = {name(t[0]), name(t[1]), name(t[2])};
        std::rotate(u.begin(), std::min_element(u.begin(), u.end()), u.end());
        out.insert(u);
      }
      return out;
    };
    CHECK(triangles(again, [&](Index v) { return found.order[v]; }) ==
          triangles(mixed, [](Index v) { return v; }));
  }
}

TEST_CASE("detail_sizes: large where a point was moved, nothing without subdivision", "[multires]") {
  Shell fine = subdivided(surfaces::octahedron(), 4);
  fine.points.back() += Vector(0, 0, 0.25);
  const std::vector<double> sizes = detail_sizes(fine);
  REQUIRE(sizes.size() == fine.points.size());
  CHECK(sizes.back() == Approx(0.25));
  CHECK(*std::ranges::max_element(sizes) == sizes.back());
  CHECK(detail_sizes(surfaces::height_field(5, false)).empty());
}

TEST_CASE("find_subdivision: patches and creases inside them do not matter", "[multires]") {
  Shell fine = subdivided(surfaces::bumpy_sphere(1), 2);
  REQUIRE(fine.patches.size() == 8);
  const SubdivisionConnectivity without = find_subdivision(fine);
  fine.creases = {{0, fine.triangles[0][1]}};
  const SubdivisionConnectivity with = find_subdivision(fine);
  CHECK(with.levels >= 3);
  CHECK(with.order == without.order);
  CHECK(with.base.patches.size() == 8);
  CHECK(with.base.creases.empty());
}

TEST_CASE("subdivided: attributes follow the points or the middles of edges", "[multires]") {
  Shell shell = surfaces::height_field(6, false);
  for (const Point& p : shell.points) {
    shell.texture_coordinates.push_back(p.head<2>());
    shell.point_colors.push_back(p.x() > 0.4 ? Eigen::Vector4d::Ones() : Eigen::Vector4d(0, 0.5, 0, 1));
  }
  const Shell middles = subdivided(shell, 2),
              butterfly = subdivided(shell, 2, {.attributes = AttributeRule::Butterfly});
  double apart = 0, between = 0;
  for (std::size_t v = 0; v < butterfly.points.size(); ++v) {
    CHECK((butterfly.texture_coordinates[v] - butterfly.points[v].head<2>()).norm() <= 1e-14);
    apart = std::max(apart, (middles.texture_coordinates[v] - middles.points[v].head<2>()).norm());
    CHECK(butterfly.point_colors[v].minCoeff() >= 0);
    CHECK(butterfly.point_colors[v].maxCoeff() <= 1);
    between = std::max(between, (middles.point_colors[v] - butterfly.point_colors[v]).norm());
  }
  CHECK(apart > 1e-3);
  CHECK(between > 1e-3);
}

TEST_CASE("find_subdivision: other meshes are none", "[multires]") {
  Shell shell = surfaces::bumpy_sphere(2);
  shell.triangles.pop_back();
  --shell.patches.back().triangle_count;
  CHECK(find_subdivision(shell).levels == 0);
  CHECK(find_subdivision(surfaces::octahedron()).levels == 0);
  CHECK(find_subdivision(surfaces::height_field(5, false)).levels == 0);
  CHECK(find_subdivision(Shell{}).levels == 0);
}

TEST_CASE("WaveletTransform: frames are perpendicular, with the normal first, and the axes at borders",
          "[multires]") {
  const Shell base = surfaces::height_field(4, false);
  const WaveletTransform transform(base, 2);
  const Shell fine = subdivided(base, 1);
  const auto frames = transform.detail_frames(1, fine.points);
  REQUIRE(frames.size() == transform.vertex_count(2) - transform.vertex_count(1));
  const Shell finest = subdivided(base, 2);
  std::size_t inner = 0;
  for (std::size_t e = 0; e < frames.size(); ++e) {
    const Point& p = finest.points[transform.vertex_count(1) + e];
    if (frames[e] == Eigen::Matrix3d::Identity()) {
      const bool border = std::min({p.x(), p.y(), 1 - p.x(), 1 - p.y()}) < 0.03;
      CHECK((border || std::abs(p.x() - 0.5) < 0.03));
      continue;
    }
    ++inner;
    const Vector lengths(1, 4, 4);
    const Eigen::Matrix3d product = frames[e].transpose() * frames[e];
    CHECK((product - Eigen::Matrix3d(lengths.array().square().matrix().asDiagonal())).norm() <= 1e-12);
    CHECK(frames[e](2, 0) > 0.5);
  }
  CHECK(inner > frames.size() / 2);
}
