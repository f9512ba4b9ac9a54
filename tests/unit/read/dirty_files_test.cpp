// Dirty meshes as files: what is reported, and the loops, against a count by hand and by brute force.

#include "meshcontour/boundary.hpp"
#include "meshcontour/cleaning.hpp"
#include "meshcontour/mesh_write.hpp"
#include "meshcontour/read.hpp"
#include "support/catch.hpp"
#include "support/dirty_meshes.hpp"

using namespace meshcontour;

namespace {

struct Case {
  std::string name;
  Shell shell;
  std::string report;              // the warnings, without file and "warning:", joined by "; "
  std::vector<std::size_t> loops;  // their sizes, sorted; the closed ones
  std::size_t open_chains = 0;
};

std::vector<Case> cases() {
  const Shell cube = dirty::cube();
  const Triangle first = cube.triangles[0];
  return {
      {"Moebius strip",
       dirty::moebius_strip(),
       "component that cannot be oriented (as a Moebius strip), kept",
       {24}},
      {"Klein bottle",
       dirty::klein_bottle(),
       "component that cannot be oriented (as a Moebius strip), kept",
       {}},
      {"bow tie", dirty::bow_tie(), "point where fans of triangles only touch (bow tie), kept", {3, 3}},
      {"three triangles on an edge", dirty::fin(), "edge with three or more triangles, kept", {4}, 1},
      {"flipped",
       dirty::with_turned(dirty::band(9, 0), {2, 5, 6}),
       "triangle that runs against its neighbours, turned round (3 times)",
       {9, 9}},
      {"duplicated",
       dirty::with_triangles(cube, {first, {first[1], first[0], first[2]}}),
       "triangle with the points of an earlier one, removed (2 times)",
       {}},
      {"degenerate",
       dirty::with_triangles(cube, {{1, 1, 2}, {4, 4, 4}}),
       "triangle that names a point twice, removed (2 times)",
       {}},
      {"isolated points",
       dirty::with_isolated_points(cube, 100'000),
       "point that no triangle uses, left out (100000 times)",
       {}},
      {"two shells touching in a vertex",
       dirty::two_cubes_touching_in_a_vertex(),
       "point where fans of triangles only touch (bow tie), kept",
       {}},
  };
}

Model model_of(Shell shell) {
  Model model;
  model.shells.push_back(std::move(shell));
  model.instances = {{0, Eigen::Affine3d::Identity(), ""}};
  return model;
}

Model through_file(const Shell& shell, MeshFormat format, std::string_view name) {
  StringSink file;
  std::vector<Diagnostic> notes;
  write_mesh(format, model_of(shell), {}, file, notes);
  return read_model(file.text, name);
}

std::string warnings(const Model& model) {
  std::string text;
  for (const Diagnostic& diagnostic : model.diagnostics) {
    if (diagnostic.severity != Diagnostic::Severity::Warning) continue;
    const std::string line = diagnostic.text();
    text += (text.empty() ? "" : "; ") + line.substr(line.find("warning: ") + 9);
  }
  return text;
}

PatchBoundary boundary_of(const Model& model) {
  std::vector<Diagnostic> diagnostics;
  return extract_boundaries(model, {}, diagnostics).at(0).patches.at(0);
}

using Edges = std::multiset<std::pair<Index, Index>>;

Edges edges_of_loops(const PatchBoundary& boundary) {
  Edges edges;
  for (const BoundaryLoop& loop : boundary.loops) {
    const std::size_t size = loop.vertices.size();
    for (std::size_t i = 0; i + (loop.closed ? 0 : 1) < size; ++i) {
      edges.insert(std::minmax(loop.vertices[i], loop.vertices[(i + 1) % size]));
    }
  }
  return edges;
}

Edges edges_with_one_triangle(const Shell& shell) {
  Edges edges;
  for (const auto& [edge, triangles] : dirty::triangles_by_edge(shell)) {
    if (triangles.size() == 1) edges.insert(edge);
  }
  return edges;
}

std::vector<std::size_t> closed_sizes(const PatchBoundary& boundary) {
  std::vector<std::size_t> sizes;
  for (const BoundaryLoop& loop : boundary.loops) {
    if (loop.closed) sizes.push_back(loop.vertices.size());
  }
  std::ranges::sort(sizes);
  return sizes;
}

}  // namespace

TEST_CASE("dirty files: each fault is reported once, and the loops are the edges with one triangle",
          "[read][dirty]") {
  for (const Case& c : cases()) {
    INFO(c.name);
    const Model model = through_file(c.shell, MeshFormat::Off, "a.off");
    CHECK(warnings(model) == c.report);
    const PatchBoundary boundary = boundary_of(model);
    CHECK(edges_of_loops(boundary) == edges_with_one_triangle(model.shells[0]));
    CHECK(closed_sizes(boundary) == c.loops);
    CHECK(boundary.loops.size() - c.loops.size() == c.open_chains);
  }
}

TEST_CASE("dirty files: the same loops from STL, where points are welded", "[read][dirty]") {
  for (const Case& c : cases()) {
    INFO(c.name);
    const Model model = through_file(c.shell, MeshFormat::Stl, "a.stl");
    const PatchBoundary boundary = boundary_of(model);
    CHECK(edges_of_loops(boundary) == edges_with_one_triangle(model.shells[0]));
    CHECK(closed_sizes(boundary) == c.loops);
    if (c.name != "isolated points") CHECK(warnings(model) == c.report);
  }
}

TEST_CASE("dirty files: repaired meshes have closed loops only, and read back without a warning",
          "[read][dirty]") {
  for (const Case& c : cases()) {
    INFO(c.name);
    Model model = through_file(c.shell, MeshFormat::Off, "a.off");
    repair_model(model);
    const Model again = through_file(model.shells[0], MeshFormat::Ply, "a.ply");
    CHECK(warnings(again).empty());
    CHECK(again.shells[0].triangles == model.shells[0].triangles);
    for (const BoundaryLoop& loop : boundary_of(again).loops) CHECK(loop.closed);
  }
}

TEST_CASE("dirty files: strict refuses each fault", "[read][dirty][error]") {
  ReadOptions strict;
  strict.strict = true;
  for (const Case& c : cases()) {
    INFO(c.name);
    StringSink file;
    std::vector<Diagnostic> notes;
    write_mesh(MeshFormat::Off, model_of(c.shell), {}, file, notes);
    try {
      read_model(file.text, "a.off", strict);
      FAIL("accepted");
    } catch (const Error& error) {
      CHECK(error.code() == ErrorCode::BadData);
      CHECK(Catch::contains(std::string(error.what()), c.report.substr(0, c.report.find(" ("))));
    }
  }
}
