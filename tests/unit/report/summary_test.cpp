#include "support/catch.hpp"
#include "unit/write/sample.hpp"

using namespace meshcontour;
using Catch::Contains;

TEST_CASE("counts_of: boundary points once a shell, edges a patch", "[report]") {
  Sample s = sample();
  PatchBoundary& patch = s.boundaries[0].patches[1];
  std::vector<BoundaryEdge> edges(patch.edges.begin(), patch.edges.end());
  edges.push_back({0, 1});
  patch.edges = std::move(edges);
  open_loop(patch, 0);
  s.model.instances.push_back(s.model.instances[0]);
  const Counts counts = counts_of(s.model, s.boundaries, s.contours);
  CHECK(counts.shells == 1);
  CHECK(counts.instances == 2);
  CHECK(counts.patches == 2);
  CHECK(counts.vertices == 10);
  CHECK(counts.triangles == 2);
  CHECK(counts.boundary_vertices == 7);
  CHECK(counts.boundary_edges == 8);
  CHECK(counts.loops == 5);
  CHECK(counts.open_chains == 1);
  CHECK(counts.segments == 10);
}

TEST_CASE("summary: counts, a row a patch, a row a stage", "[report]") {
  Sample s = sample();
  open_loop(s.boundaries[0].patches[1], 3);
  const std::vector<StageTime> timings = {{"read", 0, 12.345, 10, 2}, {"loops", 0, 1, 2, 5}};
  const std::string text = summary(s.model, s.boundaries, s.contours, timings);
  INFO(text);
  CHECK_THAT(text, Contains("sample\n\nvertices   10     boundary points   7\n"));
  CHECK_THAT(
      text,
      Contains(
          "id7        1          1      4      1  4                  1 line, 1 arc, 1 ellipse, 1 spline"));
  CHECK_THAT(text, Contains("id7        2          1      3      4  1 1 1 3(open)"));
  CHECK_THAT(text, Contains("curves: 4 lines, 1 arc, 1 circle, 2 ellipses, 2 splines\n"));
  CHECK_THAT(text, Contains("read     12.35   10.00      2\n"));
  CHECK_THAT(text, Contains("total    13.35   12.00\n"));
}

TEST_CASE("summary: many patches are counted by their loops, and those that stand out are named",
          "[report]") {
  Sample s = sample();
  Shell& shell = s.model.shells[0];
  shell.patches.resize(200);
  s.boundaries[0].patches.resize(200);
  s.boundaries[0].patches[149].nonmanifold_edges = 1;
  open_loop(s.boundaries[0].patches[1], 0);
  const std::string text = summary(s.model, s.boundaries, {}, {});
  INFO(text);
  CHECK_THAT(text,
             Contains("loops per patch  patches\n              0      198\n              1        1\n"));
  CHECK_THAT(text, Contains("shell id7 patch 2: 1 open chain\n"));
  CHECK_THAT(text, Contains("shell id7 patch 150: 1 edge with three or more triangles\n"));
}

TEST_CASE("summary: names cannot command a terminal", "[report]") {
  Sample s = sample();
  s.model.name = "\x1b[31mred";
  s.model.shells[0].id = "\x1b]0;x\x07";
  CHECK(summary(s.model, s.boundaries, {}, {}).find('\x1b') == std::string::npos);
}
