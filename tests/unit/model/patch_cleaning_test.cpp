#include <algorithm>
#include <random>
#include <set>

#include "meshcontour/cleaning.hpp"
#include "support/catch.hpp"

using namespace meshcontour;

namespace {

Shell shell_of(std::vector<std::vector<Triangle>> patches, std::size_t points) {
  Shell shell;
  shell.id.assign(1, 's');
  shell.points.resize(points, Point::Zero());
  for (const auto& triangles : patches) {
    shell.patches.push_back({"", {}, shell.triangles.size(), triangles.size()});
    shell.triangles.insert(shell.triangles.end(), triangles.begin(), triangles.end());
  }
  for (std::size_t t = 0; t < shell.triangles.size(); ++t) {
    shell.corner_normals.insert(shell.corner_normals.end(), 3, Vector::Constant(static_cast<double>(t)));
  }
  return shell;
}

Triangle lowest_first(Triangle t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

}  // namespace

TEST_CASE("drop_degenerate_and_duplicate_triangles: only copies in one patch and one direction go",
          "[model]") {
  Shell shell = shell_of(
      {{{0, 1, 2}, {3, 3, 1}, {1, 2, 0}, {2, 1, 0}}, {{0, 1, 2}, {4, 5, 4}, {0, 1, 2}, {1, 2, 3}}}, 6);
  std::vector<Diagnostic> found;
  CHECK(drop_degenerate_and_duplicate_triangles(shell, found) == 4);
  CHECK(shell.triangles == std::vector<Triangle>{{0, 1, 2}, {2, 1, 0}, {0, 1, 2}, {1, 2, 3}});
  CHECK(shell.patches[0].triangle_count == 2);
  CHECK(shell.patches[1].first_triangle == 2);
  CHECK(shell.patches[1].triangle_count == 2);
  REQUIRE(shell.corner_normals.size() == 12);
  CHECK(shell.corner_normals[9] == Vector(7, 7, 7));
  REQUIRE(found.size() == 2);
  CHECK(found[0].count == 2);
  CHECK(found[1].text() ==
        "shell s, patch 1: warning: a copy of a triangle of the same patch is left out (2 times)");
}

TEST_CASE("drop_degenerate_and_duplicate_triangles: a clean shell stays as it is", "[model]") {
  Shell shell = shell_of({{{0, 1, 2}, {0, 2, 3}}, {}}, 4);
  const auto before = shell.triangles;
  std::vector<Diagnostic> found;
  CHECK(drop_degenerate_and_duplicate_triangles(shell, found) == 0);
  CHECK(shell.triangles == before);
  CHECK(found.empty());
}

TEST_CASE("drop_degenerate_and_duplicate_triangles: finds what a set finds, for any threads",
          "[model][property]") {
  const unsigned points = GENERATE(4u, 9u, 40u, 500u);
  const unsigned threads = GENERATE(1u, 3u);
  std::mt19937 random(points);
  std::vector<std::vector<Triangle>> patches(5), expected;
  for (std::size_t p = 0; p < patches.size(); ++p) {
    const std::size_t count = p * p * 100;
    for (std::size_t i = 0; i < count; ++i) {
      patches[p].push_back({Index(random() % points), Index(random() % points), Index(random() % points)});
    }
    std::set<Triangle> seen;
    expected.emplace_back();
    for (const Triangle& t : patches[p]) {
      const bool degenerate = t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
      if (!degenerate && seen.insert(lowest_first(t)).second) expected.back().push_back(t);
    }
  }
  Shell shell = shell_of(patches, points);
  std::vector<Diagnostic> found;
  drop_degenerate_and_duplicate_triangles(shell, found, threads);
  for (std::size_t p = 0; p < patches.size(); ++p) {
    const auto kept = shell.patch_triangles(p);
    CHECK(std::vector<Triangle>(kept.begin(), kept.end()) == expected[p]);
  }
}

TEST_CASE("count_unused_points: counts what no triangle names", "[model]") {
  CHECK(count_unused_points(shell_of({{{0, 1, 2}}}, 5)) == 2);
  CHECK(count_unused_points(shell_of({{}}, 2)) == 2);
}
