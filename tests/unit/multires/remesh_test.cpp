#include <numbers>

#include "meshcontour/read.hpp"
#include "meshcontour/remeshing.hpp"
#include "meshcontour/simplification.hpp"
#include "multires/curve_split.hpp"
#include "support/catch.hpp"
#include "support/dirty_meshes.hpp"
#include "support/meshes.hpp"
#include "support/paths.hpp"
#include "surfaces.hpp"

using namespace meshcontour;
using Catch::Contains;

namespace {

// Collapsed, so that nothing of a subdivision is left.
Shell irregular(Shell shell, std::size_t triangles) {
  SimplifyOptions options;
  options.method = SimplifyMethod::Qem;
  options.goal = SimplifyGoal::Triangles;
  options.value = static_cast<double>(triangles);
  simplify_shell(shell, options, triangles);
  return surfaces::shuffled(shell, 3);
}

Shell torus(Index around, Index along) {
  Shell shell = meshes::shell(meshes::torus(around, along));
  std::mt19937 random(5);
  for (Index v = 0; v < shell.points.size(); ++v) {
    const double a = 2 * std::numbers::pi * (v % around + 0.3 * surfaces::uniform(random)) / around,
                 b = 2 * std::numbers::pi * (v / around + 0.3 * surfaces::uniform(random)) / along;
    const double r = 1 + 0.4 * std::cos(a);
    shell.points[v] = {r * std::cos(b), r * std::sin(b), 0.4 * std::sin(a)};
  }
  return shell;
}

Shell stud() {
  return read_model(std::string(MESHCONTOUR_DATA_DIR) + "/stud.xml").shells.at(0);
}

Shell sample(int kind) {
  if (kind == 0) return irregular(surfaces::bumpy_sphere(4), 1200);
  if (kind == 1) return irregular(surfaces::height_field(40, true), 1500);
  if (kind == 2) return surfaces::height_field(24, true, 0);
  if (kind == 3) return torus(24, 40);
  return stud();
}

double area_of(const Shell& shell) {
  double area = 0;
  for (const auto& [a, b, c] : shell.triangles)
    area += (shell.points[b] - shell.points[a]).cross(shell.points[c] - shell.points[a]).norm() / 2;
  return area;
}

// Sides of one patch's triangles without a partner.
std::vector<std::array<Point, 2>> border_of(const Shell& shell, std::size_t patch) {
  std::vector<std::array<Point, 2>> border;
  for (const BoundaryEdge& edge : sorted_boundary_edges(shell.patch_triangles(patch)))
    border.push_back({shell.points[edge.from], shell.points[edge.to]});
  return border;
}

double distance(const Point& p, const std::array<Point, 2>& side) {
  const Vector along = side[1] - side[0];
  const double share = std::clamp((p - side[0]).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (side[0] + share * along - p).norm();
}

}  // namespace

TEST_CASE("remeshed: a subdivision mesh of the same topology, its curves those that there were",
          "[multires][property]") {
  const Shell before = sample(GENERATE(range(0, 5)));
  const Remesh remesh = remeshed(before);
  const Shell& after = remesh.shell;
  CHECK(remesh.connectivity.levels >= 1);
  CHECK(after.triangles == subdivided(remesh.connectivity.base, remesh.connectivity.levels).triangles);
  CHECK(find_subdivision(after).levels >= remesh.connectivity.levels);
  const surfaces::Topology was = surfaces::topology_of(before), is = surfaces::topology_of(after);
  CHECK(is.manifold);
  CHECK(is.euler == was.euler);
  // Every vertex of the old loops is one of the new ones, in the same order.
  CHECK(surfaces::loops_thinned(after, before));
  CHECK(remesh.flipped == 0);
}

TEST_CASE("remeshed: every point lies where its place says, border points on the border", "[multires]") {
  const Shell before = sample(GENERATE(range(0, 5)));
  const Remesh remesh = remeshed(before);
  REQUIRE(remesh.places.size() == remesh.shell.points.size());
  for (std::size_t v = 0; v < remesh.places.size(); ++v) {
    const auto& [triangle, weights] = remesh.places[v];
    Point p = Point::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      CHECK(weights[k] >= 0);
      p += weights[k] * before.points[before.triangles[triangle][k]];
    }
    CHECK((p - remesh.shell.points[v]).norm() <= 1e-12 * (1 + p.norm()));
  }
  const double size = bounding_box(before).diagonal().norm();
  for (std::size_t patch = 0; patch < before.patches.size(); ++patch) {
    const auto old_border = border_of(before, patch);
    for (const auto& side : border_of(remesh.shell, patch)) {
      const Point middle = (side[0] + side[1]) / 2;
      const bool on_border = std::ranges::any_of(
          old_border, [&](const auto& old) { return distance(middle, old) <= 1e-12 * size; });
      CHECK(on_border);
    }
  }
}

TEST_CASE("remeshed: nothing is turned over or covered twice", "[multires]") {
  SECTION("a sphere with bumps, seen from its centre") {
    const Remesh remesh = remeshed(sample(0));
    std::size_t turned = 0;
    for (const auto& [a, b, c] : remesh.shell.triangles) {
      const Point &p = remesh.shell.points[a], &q = remesh.shell.points[b], &r = remesh.shell.points[c];
      turned += p.dot(q.cross(r)) <= 0;
    }
    CHECK(double(turned) <= 5e-4 * double(remesh.shell.triangles.size()));
  }
  SECTION("a plane") {
    const Shell flat = sample(2);
    CHECK(area_of(remeshed(flat).shell) == Approx(area_of(flat)).epsilon(1e-9));
  }
}

TEST_CASE("remeshed: its error is that of points spread over both surfaces", "[multires]") {
  const int kind = GENERATE(range(0, 3));
  const Shell before = kind == 0   ? irregular(surfaces::bumpy_sphere(3), 200)
                       : kind == 1 ? irregular(surfaces::height_field(16, true), 250)
                                   : stud();
  const Remesh remesh = remeshed(before);
  const double sampled = std::max(surfaces::sampled_distance(before, remesh.shell),
                                  surfaces::sampled_distance(remesh.shell, before));
  CHECK(sampled <= remesh.error * (1 + 1e-9) + 1e-12);
  CHECK(sampled >= 0.7 * remesh.error);
  CHECK(remesh.error <= 5e-3 * bounding_box(before).diagonal().norm());
}

TEST_CASE("remeshed: a tolerance makes it nearer", "[multires]") {
  const Shell before = sample(1);
  RemeshOptions options;
  options.tolerance = remeshed(before).error / 3;
  CHECK(remeshed(before, options).error <= options.tolerance);
}

TEST_CASE("remeshed: what points carry is carried along", "[multires]") {
  Shell before = sample(1);
  for (const Point& p : before.points) {
    before.point_colors.emplace_back(p.x(), p.y(), p.z(), 1);
    before.texture_coordinates.emplace_back(p.x(), p.z());
  }
  const Shell after = remeshed(before).shell;
  REQUIRE(after.point_colors.size() == after.points.size());
  REQUIRE(after.texture_coordinates.size() == after.points.size());
  for (std::size_t v = 0; v < after.points.size(); ++v) {
    CHECK((after.point_colors[v].head<3>() - after.points[v]).norm() <= 1e-12);
    CHECK(std::abs(after.texture_coordinates[v].y() - after.points[v].z()) <= 1e-12);
  }
}

TEST_CASE("remeshed: the same bits for any number of threads", "[multires]") {
  const Shell before = sample(0);
  RemeshOptions one, many;
  one.threads = 1;
  many.threads = 4;
  const Remesh a = remeshed(before, one), b = remeshed(before, many);
  CHECK(a.shell.points == b.shell.points);
  CHECK(a.shell.triangles == b.shell.triangles);
  CHECK(a.error == b.error);
}

TEST_CASE("remeshed: any mesh of the family is covered or refused with its name", "[multires][property]") {
  for (const meshes::Mesh& mesh : meshes::family()) {
    // Larger ones cross themselves too often, as their points mean nothing.
    if (mesh.triangles.size() > 100) continue;
    Shell before = meshes::shell(mesh);
    INFO(mesh.name);
    before.id = "odd";
    try {
      const Remesh remesh = remeshed(before);
      CHECK(mesh.manifold);
      CHECK(surfaces::topology_of(remesh.shell).euler == surfaces::topology_of(before).euler);
    } catch (const Error& error) {
      CHECK(error.code() == ErrorCode::BadData);
      CHECK_THAT(error.what(), Contains("shell odd: "));
      const bool turned = mesh.name.find("partly flipped") != std::string::npos;
      CHECK((!mesh.manifold || !mesh.orientable || turned || before.triangles.empty()));
    }
  }
}

TEST_CASE("remeshed: messages say what is wrong and what helps", "[multires][error]") {
  Shell fin = dirty::fin();
  fin.id = "a\nb";
  CHECK_THROWS_WITH(remeshed(fin), Contains("3 triangles: not an orientable manifold") &&
                                       Contains("--repair") && !Contains("\n"));
  CHECK_THROWS_WITH(remeshed(Shell{}), Contains("no triangles"));
  CHECK_THROWS_WITH(remeshed(dirty::band(9, 1)), Contains("same way"));
  RemeshOptions options;
  options.most_levels = 0;
  CHECK_THROWS_WITH(remeshed(surfaces::octahedron(), options), Contains("1 to 8 levels"));
}

TEST_CASE("remeshed: triangles without an area break nothing", "[multires][error]") {
  Shell shell = surfaces::height_field(12, false);
  for (std::size_t v = 0; v < shell.points.size(); ++v) {
    if (v % 7 == 3) shell.points[v] = shell.points[v - 1];
  }
  const Remesh remesh = remeshed(shell);
  for (const Point& p : remesh.shell.points) CHECK(p.allFinite());
  CHECK(surfaces::topology_of(remesh.shell).euler == 1);
  Shell point = surfaces::bumpy_sphere(3);
  for (Point& p : point.points) p = {1, 2, 3};
  CHECK(remeshed(point).error <= 1e-12);
}

TEST_CASE("simplify_shell: wavelets on a remesh keep the error asked for, and loops", "[multires]") {
  const Shell before = sample(GENERATE(0, 1, 4));
  Shell after = before;
  SimplifyOptions options;
  options.method = SimplifyMethod::Wavelet;
  options.goal = SimplifyGoal::Error;
  options.value = 0.01 * bounding_box(before).diagonal().norm();
  const Simplification result = simplify_shell(after, options, 0);
  CHECK(result.method == SimplifyMethod::Wavelet);
  CHECK(result.remesh_triangles > before.triangles.size());
  CHECK(result.remesh_error <= options.value);
  CHECK(result.error <= options.value);
  CHECK(after.triangles.size() < before.triangles.size());
  CHECK(patch_distance(before, after).upper <= options.value);
  const surfaces::Topology was = surfaces::topology_of(before), is = surfaces::topology_of(after);
  CHECK(is.manifold);
  CHECK(is.euler == was.euler);
  const auto loops = surfaces::boundaries_of(after);
  const auto old_loops = surfaces::boundaries_of(before);
  for (std::size_t p = 0; p < before.patches.size(); ++p) {
    const auto &a = old_loops[0].patches[p].loops, &b = loops[0].patches[p].loops;
    REQUIRE(a.size() == b.size());
    for (std::size_t l = 0; l < a.size(); ++l)
      CHECK(before.points[a[l].vertices[0]] == after.points[b[l].vertices[0]]);
  }
}

TEST_CASE("simplify_shell: few triangles are reached by a coarser base mesh", "[multires]") {
  Shell shell = sample(0);
  SimplifyOptions options;
  options.method = SimplifyMethod::Wavelet;
  options.goal = SimplifyGoal::Triangles;
  options.value = 60;
  CHECK(simplify_shell(shell, options, 60).triangles_after <= 60);
}

TEST_CASE("with_remeshed_shells: others stay, and notes say which", "[multires]") {
  Model model;
  model.shells = {subdivided(surfaces::octahedron(), 2), sample(1), dirty::fin()};
  const ModelRemesh remesh = remeshed_model(model);
  const Model out = with_remeshed_shells(model, remesh);
  const std::vector<Diagnostic>& notes = remesh.notes;
  REQUIRE(remesh.shells.size() == 3);
  CHECK(remesh.shells[1]->shell.points == out.shells[1].points);
  CHECK(out.shells[0].triangles == model.shells[0].triangles);
  CHECK(find_subdivision(out.shells[1]).levels > 0);
  CHECK(out.shells[2].triangles == model.shells[2].triangles);
  REQUIRE(notes.size() == 2);
  CHECK_THAT(notes[0].message, Contains("remeshed from"));
  CHECK_THAT(notes[1].message, Contains("not remeshed: "));
}

TEST_CASE("remeshed_detail_sizes: large around a dent, small elsewhere", "[multires]") {
  Shell shell = surfaces::height_field(32, false, 0);
  const Index dent = 16 * 33 + 8;
  shell.points[dent].z() = 0.05;
  const std::vector<double> sizes = remeshed_detail_sizes(shell, remeshed(shell));
  REQUIRE(sizes.size() == shell.points.size());
  CHECK(sizes[dent] > 1e-3);
  for (std::size_t v = 0; v < sizes.size(); ++v) {
    if ((shell.points[v] - shell.points[dent]).norm() > 0.6) CHECK(sizes[v] < 0.1 * sizes[dent]);
  }
}

TEST_CASE("split_curve: every vertex is hit where there are enough places", "[multires]") {
  std::mt19937 random(8);
  for (int trial = 0; trial < 200; ++trial) {
    const auto levels = static_cast<unsigned>(1 + random() % 5);
    const std::size_t most = std::size_t{1} << levels, count = 1 + random() % most;
    std::vector<double> lengths;
    for (std::size_t i = 0; i < count; ++i) lengths.push_back(std::exp(3 * surfaces::uniform(random)));
    const detail::CurveSplit split = detail::split_curve(lengths, levels);
    REQUIRE(split.places.size() == most + 1);
    for (std::size_t i = 0; i <= count; ++i)
      CHECK(std::ranges::find(split.places, double(i)) != split.places.end());
    for (std::size_t i = 1; i <= most; ++i) {
      CHECK(split.places[i] > split.places[i - 1]);
      CHECK(split.shares[i] > split.shares[i - 1]);
    }
    CHECK(split.shares.back() == Approx(1).epsilon(1e-14));
  }
}
