#include "meshcontour/segmentation.hpp"

#include "support/catch.hpp"
#include "support/dirty_meshes.hpp"

using namespace meshcontour;

namespace {

constexpr double kDegree = std::numbers::pi / 180;

double dihedral(const Shell& shell, std::size_t s, std::size_t t, std::pair<Index, Index> edge) {
  const auto normal = [&](std::size_t i) -> Vector {
    const Triangle& c = shell.triangles[i];
    return (shell.points[c[1]] - shell.points[c[0]])
        .cross(shell.points[c[2]] - shell.points[c[0]])
        .normalized();
  };
  const bool same_way = dirty::runs(shell.triangles[s], edge.first, edge.second) ==
                        dirty::runs(shell.triangles[t], edge.first, edge.second);
  return std::acos(std::clamp((same_way ? -1 : 1) * normal(s).dot(normal(t)), -1.0, 1.0));
}

// The patch of every triangle by the definition: joined over edges of two triangles that meet at less than
// the angle.
std::vector<std::size_t> brute_patches(const Shell& shell, double radians) {
  std::vector<std::pair<std::size_t, std::size_t>> links;
  for (const auto& [edge, triangles] : dirty::triangles_by_edge(shell)) {
    if (triangles.size() == 2 && dihedral(shell, triangles[0], triangles[1], edge) <= radians - 1e-4) {
      links.push_back({triangles[0], triangles[1]});
    }
  }
  return dirty::pieces(shell.triangles.size(), links);
}

// Triangles in the order of the patches that `piece` (the first member of each) gives.
std::vector<Triangle> grouped(const Shell& shell, const std::vector<std::size_t>& piece) {
  std::vector<std::size_t> order(piece.size());
  for (std::size_t t = 0; t < order.size(); ++t) order[t] = t;
  std::ranges::stable_sort(order, {}, [&](std::size_t t) { return piece[t]; });
  std::vector<Triangle> triangles;
  for (const std::size_t t : order) triangles.push_back(shell.triangles[t]);
  return triangles;
}

// Two squares that meet at the y axis and enclose the dihedral angle.
Shell folded(double radians) {
  return dirty::make_shell({{0, 0, 0},
                            {0, 1, 0},
                            {-1, 0, 0},
                            {-1, 1, 0},
                            {std::cos(radians), 0, std::sin(radians)},
                            {std::cos(radians), 1, std::sin(radians)}},
                           dirty::split_quads({{2, 0, 1, 3}, {0, 4, 5, 1}}));
}

// A cone of four triangles; the edge 0-1 is folded by 90 degrees, the others by at most 71.
Shell half_folded() {
  return dirty::make_shell({{0, 0, 0}, {1, 0, 0}, {0, 1, -1}, {-1, 0, -1}, {0, -1, -1}},
                           {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}});
}

}  // namespace

TEST_CASE("segment_by_feature_angle: a cube has six faces, each a range in the order of its triangles",
          "[model][segmentation]") {
  Shell shell = dirty::cube();
  CHECK(segment_by_feature_angle(shell, 30 * kDegree) == 6);
  CHECK(shell.triangles == dirty::cube().triangles);
  for (std::size_t p = 0; p < 6; ++p) CHECK(shell.patches[p].first_triangle == 2 * p);
  CHECK(shell.creases.empty());
}

TEST_CASE("segment_by_feature_angle: the angle itself is sharp, rounding or not", "[model][segmentation]") {
  for (const double angle : {1.0, 29.0, 31.0, 90.0, 150.0, 179.0}) {
    Shell shell = folded(angle * kDegree);
    CHECK(segment_by_feature_angle(shell, (angle + 0.01) * kDegree) == 1);
    CHECK(segment_by_feature_angle(shell, (angle + 0.001) * kDegree) == 2);
    CHECK(segment_by_feature_angle(shell, angle * kDegree) == 2);
  }
}

TEST_CASE("segment_by_feature_angle: which way triangles run does not matter", "[model][segmentation]") {
  for (std::size_t turned = 0; turned < 12; ++turned) {
    Shell shell = dirty::with_turned(dirty::cube(), {turned});
    CHECK(segment_by_feature_angle(shell, 30 * kDegree) == 6);
  }
}

TEST_CASE("segment_by_feature_angle: a sharp edge that ends inside a patch is a crease",
          "[model][segmentation]") {
  Shell shell = half_folded();
  REQUIRE(segment_by_feature_angle(shell, 80 * kDegree) == 1);
  CHECK(shell.creases == std::vector<std::array<Index, 2>>{{0, 1}});
  REQUIRE(segment_by_feature_angle(shell, 91 * kDegree) == 1);
  CHECK(shell.creases.empty());
}

TEST_CASE("segment_by_feature_angle: triangles follow their patch, corner normals follow triangles",
          "[model][segmentation]") {
  Shell shell = dirty::cube();
  std::vector<Triangle> shuffled;
  for (std::size_t t = 0; t < 12; ++t) shuffled.push_back(shell.triangles[t * 5 % 12]);
  shell.triangles = shuffled;
  for (const Triangle& t : shell.triangles) {
    for (const Index v : t) shell.corner_normals.push_back(shell.points[v]);
  }
  const Shell before = shell;
  REQUIRE(segment_by_feature_angle(shell, 30 * kDegree) == 6);
  CHECK(shell.triangles == grouped(before, brute_patches(before, 30 * kDegree)));
  for (std::size_t c = 0; c < 36; ++c) {
    CHECK(shell.corner_normals[c] == shell.points[shell.triangles[c / 3][c % 3]]);
  }
}

TEST_CASE("segment_by_feature_angle: random meshes agree with the definition",
          "[model][segmentation][property]") {
  std::mt19937 random(5);
  for (int round = 0; round < 300; ++round) {
    Shell shell = dirty::soup(random, static_cast<Index>(5 + random() % 15), random() % 40);
    std::erase_if(shell.triangles,
                  [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
    const double angle = double(1 + random() % 178) * kDegree;
    const Shell before = shell;
    const auto piece = brute_patches(before, angle);
    CHECK(segment_by_feature_angle(shell, angle) == std::set(piece.begin(), piece.end()).size());
    CHECK(shell.triangles == grouped(before, piece));
    Model model;
    model.shells = {shell};
    CHECK_NOTHROW(validate(model));
  }
}

TEST_CASE("segment_by_feature_angle: slivers and scale do not cut smooth surfaces", "[model][segmentation]") {
  const double scale = GENERATE(1.0, 1e-150, 1e150, 1e-3);
  // A plane square whose diagonal carries a sliver, its third corner rounded off the plane as by single
  // precision.
  Shell shell = dirty::make_shell({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 3e-8}},
                                  {{0, 1, 4}, {1, 2, 4}, {0, 4, 2}, {0, 2, 3}});
  shell.points[4] += Vector(1e-8, -1e-8, 0);
  for (Point& p : shell.points) p *= scale;
  CHECK(segment_by_feature_angle(shell, 30 * kDegree) == 1);
}

TEST_CASE("segment_by_feature_angle: an angle out of range is refused", "[model][segmentation][error]") {
  Shell shell = dirty::cube();
  for (const double angle : {0.0, -1.0, 180.0 * kDegree, std::nan("")}) {
    CHECK_THROWS_AS(segment_by_feature_angle(shell, angle), Error);
  }
}

TEST_CASE("segment_by_components: edges join, points do not", "[model][segmentation]") {
  Shell cubes = dirty::two_cubes_touching_in_a_vertex();
  CHECK(segment_by_components(cubes) == 2);
  Shell fin = dirty::fin();
  CHECK(segment_by_components(fin) == 1);
  Shell none = dirty::make_shell({}, {});
  CHECK(segment_by_components(none) == 0);
}

TEST_CASE("segment_model: automatic keeps the patches of a file that has some", "[model][segmentation]") {
  Model model;
  model.shells = {dirty::cube()};
  const auto patches = [&](PatchSource source, bool has_patches) {
    Model copy = model;
    copy.has_patches = has_patches;
    segment_model(copy, {source});
    return copy.shells[0].patches.size();
  };
  CHECK(patches(PatchSource::Automatic, true) == 1);
  CHECK(patches(PatchSource::Automatic, false) == 6);
  CHECK(patches(PatchSource::File, false) == 1);
  CHECK(patches(PatchSource::Angle, true) == 6);
  CHECK(patches(PatchSource::Components, true) == 1);
  model.shells = {half_folded()};
  segment_model(model, {PatchSource::Angle, 80 * kDegree});
  REQUIRE(model.diagnostics.size() == 1);
  CHECK(model.diagnostics[0].severity == Diagnostic::Severity::Note);
}
