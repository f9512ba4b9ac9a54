#include "meshcontour/cleaning.hpp"

#include "support/catch.hpp"
#include "support/dirty_meshes.hpp"

using namespace meshcontour;

namespace {

struct Cleaned {
  Shell shell;
  CleaningCounts counts;
  std::vector<Diagnostic> diagnostics;
};

Cleaned cleaned(Shell shell) {
  Cleaned result{std::move(shell), {}, {}};
  result.counts = clean_shell(result.shell, Spot{"a.stl", 0, 0, ""}, result.diagnostics);
  return result;
}

std::size_t brute_nonmanifold_edges(const dirty::EdgeTriangles& edges) {
  return static_cast<std::size_t>(
      std::ranges::count_if(edges, [](const auto& e) { return e.second.size() > 2; }));
}

std::size_t brute_bow_ties(const Shell& shell, const dirty::EdgeTriangles& edges) {
  std::set<Index> on_nonmanifold_edge;
  for (const auto& [edge, triangles] : edges) {
    if (triangles.size() > 2) on_nonmanifold_edge.insert({edge.first, edge.second});
  }
  std::size_t count = 0;
  for (Index v = 0; v < shell.points.size(); ++v) {
    if (on_nonmanifold_edge.contains(v)) continue;
    const auto always = [](const auto&, const auto&) { return true; };
    count += dirty::fan_count(shell, edges, v, always) > 1 ? 1 : 0;
  }
  return count;
}

bool runs_both_ways(const Shell& shell, std::pair<Index, Index> edge,
                    const std::vector<std::size_t>& triangles) {
  const bool first = dirty::runs(shell.triangles[triangles[0]], edge.first, edge.second);
  return first != dirty::runs(shell.triangles[triangles[1]], edge.first, edge.second);
}

std::size_t brute_conflicts(const Shell& shell, const dirty::EdgeTriangles& edges) {
  return static_cast<std::size_t>(std::ranges::count_if(edges, [&](const auto& e) {
    return e.second.size() == 2 && !runs_both_ways(shell, e.first, e.second);
  }));
}

double volume(const Shell& shell) {
  double sum = 0;
  for (const Triangle& t : shell.triangles) {
    sum += shell.points[t[0]].dot(shell.points[t[1]].cross(shell.points[t[2]]));
  }
  return sum / 6;
}

// Corners of every triangle in space, whatever its direction.
std::multiset<std::set<std::array<double, 3>>> places(const Shell& shell) {
  std::multiset<std::set<std::array<double, 3>>> result;
  for (const Triangle& t : shell.triangles) {
    std::set<std::array<double, 3>> corners;
    for (const Index v : t) corners.insert({shell.points[v].x(), shell.points[v].y(), shell.points[v].z()});
    result.insert(corners);
  }
  return result;
}

void check_manifold(const Shell& shell) {
  const auto edges = dirty::triangles_by_edge(shell);
  CHECK(brute_nonmanifold_edges(edges) == 0);
  CHECK(brute_conflicts(shell, edges) == 0);
  for (Index v = 0; v < shell.points.size(); ++v) {
    const auto both_ways = [&](const auto& edge, const auto& t) { return runs_both_ways(shell, edge, t); };
    CHECK(dirty::fan_count(shell, edges, v, both_ways) == 1);  // used, and by one fan
  }
}

}  // namespace

TEST_CASE("clean_shell: a sound mesh is left alone", "[model][cleaning]") {
  for (const Shell& shell : {dirty::cube(), dirty::torus(), dirty::band(9, 0), dirty::band(9, 2)}) {
    const Cleaned result = cleaned(shell);
    CHECK(result.shell.triangles == shell.triangles);
    CHECK(result.diagnostics.empty());
  }
}

TEST_CASE("clean_shell: each fault is counted under its own name", "[model][cleaning]") {
  SECTION("unused points stay, so that indices keep their meaning") {
    const Cleaned result = cleaned(dirty::with_isolated_points(dirty::cube(), 100'000));
    CHECK(result.counts.unused_points == 100'000);
    CHECK(result.shell.points.size() == 100'008);
    REQUIRE(result.diagnostics.size() == 1);
    CHECK(result.diagnostics[0].text() ==
          "a.stl: warning: point that no triangle uses, left out (100000 times)");
  }
  SECTION("triangles without three points") {
    const Cleaned result = cleaned(dirty::with_triangles(dirty::cube(), {{1, 1, 3}, {2, 3, 2}, {5, 5, 5}}));
    CHECK(result.counts.degenerate_triangles == 3);
    CHECK(result.shell.triangles == dirty::cube().triangles);
    CHECK(result.shell.patches[0].triangle_count == 12);
  }
  SECTION("copies, rotated and reversed too; the first stays") {
    const Shell cube = dirty::cube();
    const Triangle t = cube.triangles[4];
    const Cleaned result = cleaned(dirty::with_triangles(cube, {t, {t[1], t[2], t[0]}, {t[0], t[2], t[1]}}));
    CHECK(result.counts.duplicate_triangles == 3);
    CHECK(result.shell.triangles == cube.triangles);
    CHECK(result.counts.nonmanifold_edges == 0);
  }
  SECTION("a lone triangle and its back are one triangle") {
    const Cleaned result =
        cleaned(dirty::make_shell({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}));
    CHECK(result.counts.duplicate_triangles == 1);
    CHECK(result.shell.triangles == std::vector<Triangle>{{0, 1, 2}});
  }
  SECTION("Moebius strip and Klein bottle cannot be oriented and stay as they are") {
    for (const Shell& shell : {dirty::moebius_strip(), dirty::klein_bottle()}) {
      const Cleaned result = cleaned(shell);
      CHECK(result.counts.unorientable_components == 1);
      CHECK(result.counts.turned_triangles == 0);
      CHECK(result.shell.triangles == shell.triangles);
    }
  }
  SECTION("three triangles on an edge") {
    const Cleaned result = cleaned(dirty::fin());
    CHECK(result.counts.nonmanifold_edges == 1);
    CHECK(result.counts.bow_tie_vertices == 0);
    CHECK(result.shell.triangles == dirty::fin().triangles);
  }
  SECTION("bow ties, open and closed") {
    CHECK(cleaned(dirty::bow_tie()).counts.bow_tie_vertices == 1);
    CHECK(cleaned(dirty::two_cubes_touching_in_a_vertex()).counts.bow_tie_vertices == 1);
  }
}

TEST_CASE("clean_shell: the minority of a component is turned, a closed one outward", "[model][cleaning]") {
  SECTION("open: the majority decides") {
    const Shell band = dirty::band(9, 0);
    const Cleaned few = cleaned(dirty::with_turned(band, {1, 7, 8}));
    CHECK(few.counts.turned_triangles == 3);
    CHECK(few.shell.triangles == band.triangles);
    std::vector<std::size_t> most(18);
    for (std::size_t t = 0; t < most.size(); ++t) most[t] = t;
    most.erase(most.begin() + 4);
    CHECK(cleaned(dirty::with_turned(band, most)).counts.turned_triangles == 1);
  }
  SECTION("closed: outward, even when most triangles run inward") {
    const Cleaned result = cleaned(dirty::with_turned(dirty::cube(), {0, 1, 2, 3, 4, 5, 6, 8, 9, 11}));
    CHECK(result.counts.turned_triangles == 10);
    CHECK(volume(result.shell) == Approx(1));
  }
  SECTION("a consistent void keeps its normals") {
    Shell inward = dirty::cube();
    for (Triangle& t : inward.triangles) std::swap(t[1], t[2]);
    CHECK(cleaned(inward).counts.turned_triangles == 0);
  }
  SECTION("corner normals follow their corners") {
    Shell shell = dirty::with_turned(dirty::cube(), {5});
    for (const Triangle& t : shell.triangles) {
      for (const Index v : t)
        shell.corner_normals.push_back(Vector(shell.points[v] - Point(0.5, 0.5, 0.5)).normalized());
    }
    const Cleaned result = cleaned(shell);
    REQUIRE(result.counts.turned_triangles == 1);
    for (std::size_t c = 0; c < result.shell.corner_normals.size(); ++c) {
      const Point& corner = result.shell.points[result.shell.triangles[c / 3][c % 3]];
      CHECK(result.shell.corner_normals[c].isApprox(Vector(corner - Point(0.5, 0.5, 0.5)).normalized()));
    }
  }
}

TEST_CASE("clean_shell: random soups agree with a brute-force count", "[model][cleaning][property]") {
  std::mt19937 random(7);
  for (int round = 0; round < 400; ++round) {
    const Shell soup = dirty::soup(random, static_cast<Index>(3 + random() % 12), random() % 24);
    const Cleaned result = cleaned(soup);
    std::set<std::set<Index>> distinct;
    std::size_t degenerate = 0;
    for (const Triangle& t : soup.triangles) {
      const std::set<Index> points(t.begin(), t.end());
      if (points.size() == 3) distinct.insert(points);
      degenerate += points.size() < 3 ? 1 : 0;
    }
    CHECK(result.counts.degenerate_triangles == degenerate);
    CHECK(result.counts.duplicate_triangles == soup.triangles.size() - degenerate - distinct.size());
    CHECK(result.shell.triangles.size() == distinct.size());
    CHECK(result.shell.patches[0].triangle_count == distinct.size());
    const auto edges = dirty::triangles_by_edge(result.shell);
    CHECK(result.counts.nonmanifold_edges == brute_nonmanifold_edges(edges));
    CHECK(result.counts.bow_tie_vertices == brute_bow_ties(result.shell, edges));
    if (result.counts.unorientable_components == 0) CHECK(brute_conflicts(result.shell, edges) == 0);
  }
}

TEST_CASE("clean_shell: the threads do not change the result", "[model][cleaning]") {
  std::mt19937 random(3);
  const Shell soup = dirty::soup(random, 40'000, 90'000);
  std::vector<Diagnostic> diagnostics;
  Shell one = soup, many = soup;
  const CleaningCounts first = clean_shell(one, {}, diagnostics, 1),
                       second = clean_shell(many, {}, diagnostics, 4);
  CHECK(one.triangles == many.triangles);
  CHECK(first.bow_tie_vertices == second.bow_tie_vertices);
  CHECK(first.nonmanifold_edges == second.nonmanifold_edges);
}

TEST_CASE("repair_shell: every fault becomes a manifold with the same triangles in space",
          "[model][cleaning]") {
  const std::vector<Shell> shells = {
      dirty::moebius_strip(), dirty::moebius_strip(3),
      dirty::klein_bottle(),  dirty::bow_tie(),
      dirty::fin(),           dirty::two_cubes_touching_in_a_vertex(),
      dirty::cube(),          dirty::with_isolated_points(dirty::torus(5, 4), 10)};
  for (const Shell& shell : shells) {
    Shell repaired = cleaned(shell).shell;
    repair_shell(repaired);
    check_manifold(repaired);
    CHECK(places(repaired) == places(shell));
  }
}

TEST_CASE("repair_shell: what was a manifold is not cut", "[model][cleaning]") {
  for (const Shell& shell : {dirty::cube(), dirty::torus(), dirty::band(9, 0)}) {
    Shell repaired = shell;
    const RepairCounts counts = repair_shell(repaired);
    CHECK(counts.added_points == 0);
    CHECK(repaired.triangles == shell.triangles);
  }
}

TEST_CASE("repair_shell: random soups become manifolds", "[model][cleaning][property]") {
  std::mt19937 random(11);
  for (int round = 0; round < 300; ++round) {
    Shell soup = cleaned(dirty::soup(random, static_cast<Index>(3 + random() % 12), random() % 24)).shell;
    Shell repaired = soup;
    repair_shell(repaired);
    check_manifold(repaired);
    CHECK(places(repaired) == places(soup));
  }
}

TEST_CASE("drop_unused_points: the rest keep their order", "[model][cleaning]") {
  Shell shell = dirty::make_shell({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 1, 0}, {4, 0, 0}}, {{4, 1, 3}});
  CHECK(drop_unused_points(shell) == 2);
  CHECK(shell.triangles == std::vector<Triangle>{{2, 0, 1}});
  CHECK(shell.points[2] == Point(4, 0, 0));
}

TEST_CASE("has_area: points on a line, or all alike, have none", "[model][cleaning]") {
  const std::vector<Triangle> square = {{0, 1, 2}, {0, 2, 3}};
  const Point direction(0.1, -0.7, 0.3), start(1e3, 2e3, -5e2);
  const auto on_line = [&](double t) { return Point(start + t * direction); };
  CHECK_FALSE(has_area(dirty::make_shell({on_line(0), on_line(1), on_line(2.5), on_line(7)}, square)));
  CHECK_FALSE(has_area(dirty::make_shell({start, start, start, start}, square)));
  CHECK_FALSE(has_area(dirty::make_shell({}, {})));
  CHECK(has_area(dirty::make_shell({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1e-9, 0}}, square)));
  CHECK(has_area(dirty::make_shell({{0, 0, 0}, {1e99, 0, 0}, {1e99, 1e99, 0}, {0, 1e-99, 0}}, square)));
}
