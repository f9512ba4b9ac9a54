#include "meshcontour/surface_mesh.hpp"

#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/helpers.h>

#include <algorithm>

#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace meshcontour;

namespace {

template <class Key, class Value>
auto map(const SurfaceMesh& mesh, std::string_view name) {
  const auto [result, found] = mesh.property_map<Key, Value>(std::string(name));
  REQUIRE(found);
  return result;
}

using Vertex = SurfaceMesh::Vertex_index;
using Halfedge = SurfaceMesh::Halfedge_index;
using Face = SurfaceMesh::Face_index;

// Two patches with normals that tell every corner apart.
Shell two_patches() {
  const meshes::Mesh grid = meshes::grid(4, 3);
  Shell shell = meshes::shell(meshes::united(grid, meshes::disc(6)));
  shell.patches = {{"grid", {}, 0, grid.triangles.size()}, {"disc", {}, grid.triangles.size(), 6}};
  shell.patches[1].color = {10, 20, 30, 40};
  for (std::size_t i = 0; i < 3 * shell.triangles.size(); ++i) {
    shell.corner_normals.push_back(Vector(1, static_cast<double>(i), 2).normalized());
  }
  return shell;
}

}  // namespace

TEST_CASE("to_surface_mesh: vertices, corners and faces carry what the shell says of them",
          "[boundary][surface_mesh]") {
  const Shell shell = two_patches();
  const HalfedgePatch patch = to_surface_mesh(shell, 1);
  CHECK(patch.mesh.number_of_faces() == 6);
  CHECK(patch.mesh.number_of_vertices() == 7);
  const auto vertex = map<Vertex, Index>(patch.mesh, property::kVertex);
  const auto normal = map<Halfedge, Vector>(patch.mesh, property::kNormal);
  const auto triangle = map<Face, std::size_t>(patch.mesh, property::kTriangle);
  const auto number = map<Face, std::size_t>(patch.mesh, property::kPatch);
  const auto color = map<Face, CGAL::IO::Color>(patch.mesh, property::kColor);
  for (const Face face : patch.mesh.faces()) {
    CHECK(number[face] == 1);
    CHECK(color[face] == CGAL::IO::Color(10, 20, 30, 40));
    const Triangle& t = shell.triangles[triangle[face]];
    for (const Halfedge h : patch.mesh.halfedges_around_face(patch.mesh.halfedge(face))) {
      const auto corner = std::ranges::find(t, vertex[patch.mesh.target(h)]) - t.begin();
      REQUIRE(corner < 3);
      CHECK(normal[h] == shell.corner_normals[3 * triangle[face] + static_cast<std::size_t>(corner)]);
      const auto p = patch.mesh.point(patch.mesh.target(h));
      CHECK(Point(p.x(), p.y(), p.z()) == shell.points[vertex[patch.mesh.target(h)]]);
    }
  }
}

TEST_CASE("to_surface_mesh: a border vertex has a border halfedge as its own", "[boundary][surface_mesh]") {
  const SurfaceMesh mesh = to_surface_mesh(meshes::shell(meshes::grid(9, 9, 2)), 0).mesh;
  for (const Vertex v : mesh.vertices()) {
    CHECK(mesh.is_border(v, false) == mesh.is_border(v, true));
  }
}

TEST_CASE("to_surface_mesh: what comes out is a valid polygon mesh", "[boundary][surface_mesh]") {
  for (const meshes::Mesh& mesh : meshes::family()) {
    INFO(mesh.name);
    CHECK(CGAL::is_valid_polygon_mesh(to_surface_mesh(meshes::shell(mesh), 0).mesh));
  }
}

TEST_CASE("to_surface_mesh: refused triangles are counted and listed, never lost",
          "[boundary][surface_mesh]") {
  const auto refused = [](const std::vector<Triangle>& triangles) {
    meshes::Mesh mesh{"refused", 9, triangles, false, false, {}};
    const HalfedgePatch patch = to_surface_mesh(meshes::shell(mesh), 0);
    return std::pair(patch.rejected_as_given, patch.unheld);
  };
  using Refused = std::pair<std::size_t, std::vector<std::size_t>>;
  CHECK(refused({{0, 1, 2}, {0, 2, 3}}) == Refused{0, {}});
  CHECK(refused({{0, 1, 2}, {2, 0, 3}, {3, 0, 4}}) == Refused{1, {}});   // one runs the wrong way round
  CHECK(refused({{0, 1, 2}, {1, 0, 3}, {1, 0, 4}}) == Refused{1, {2}});  // a third triangle on an edge
  CHECK(refused({{0, 1, 2}, {1, 1, 2}}) == Refused{1, {1}});             // a repeated index
  CHECK(refused({{0, 1, 2}, {1, 2, 0}, {2, 1, 0}}) == Refused{1, {2}});  // a third copy
}

TEST_CASE("to_surface_mesh: a surface whose triangles run at random is held whole",
          "[boundary][surface_mesh]") {
  for (const meshes::Mesh& plain : {meshes::grid(20, 20, 2), meshes::torus(16, 12), meshes::sphere(20, 11)}) {
    const meshes::Mesh mesh = meshes::shuffled(meshes::partly_flipped(plain, 3, 2), 4);
    INFO(mesh.name);
    const HalfedgePatch patch = to_surface_mesh(meshes::shell(mesh), 0);
    CHECK(patch.rejected_as_given > 0);
    CHECK(patch.unheld.empty());
  }
}

TEST_CASE("to_surface_mesh: a vertex with many triangles costs no more than its triangles",
          "[boundary][surface_mesh]") {
  const Shell shell = meshes::shell(meshes::disc(300'000));  // a cost of the square would take hours
  CHECK(to_surface_mesh(shell, 0).mesh.number_of_faces() == 300'000);
}

TEST_CASE("to_shell: gives back the shell", "[boundary][surface_mesh]") {
  const Shell shell = two_patches();
  const SurfaceMesh mesh = to_surface_mesh(shell).mesh;
  const auto vertex = map<Vertex, Index>(mesh, property::kVertex);
  const Shell back = to_shell(mesh, "back");
  CHECK(back.id == "back");
  REQUIRE(back.triangles.size() == shell.triangles.size());
  for (std::size_t i = 0; i < shell.triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      CHECK(vertex[Vertex(back.triangles[i][k])] == shell.triangles[i][k]);
      CHECK(back.points[back.triangles[i][k]] == shell.points[shell.triangles[i][k]]);
    }
  }
  CHECK(back.corner_normals == shell.corner_normals);
  REQUIRE(back.patches.size() == 2);
  CHECK(back.patches[1].first_triangle == shell.patches[1].first_triangle);
  CHECK(back.patches[1].color == shell.patches[1].color);
}

TEST_CASE("to_shell: triangles that were turned over come back as they were", "[boundary][surface_mesh]") {
  meshes::Mesh mesh{"one flipped", 5, {{0, 1, 2}, {2, 0, 3}, {3, 0, 4}}, true, true, 1};
  const Shell shell = meshes::shell(mesh);
  const SurfaceMesh held = to_surface_mesh(shell, 0).mesh;
  const auto vertex = map<Vertex, Index>(held, property::kVertex);
  Shell back = to_shell(held, "back");
  for (Triangle& t : back.triangles) {
    for (Index& v : t) v = vertex[Vertex(v)];
  }
  CHECK(back.triangles == shell.triangles);
}

TEST_CASE("to_shell: works after faces were removed, and without any property", "[boundary][surface_mesh]") {
  SurfaceMesh mesh;
  const auto far = mesh.add_vertex({9, 9, 9}), a = mesh.add_vertex({0, 0, 0}), b = mesh.add_vertex({1, 0, 0});
  const auto c = mesh.add_vertex({1, 1, 0}), d = mesh.add_vertex({0, 1, 0});
  const auto gone = mesh.add_face(far, c, b);
  mesh.add_face(a, b, c);
  mesh.add_face(a, c, d);
  CGAL::Euler::remove_face(mesh.halfedge(gone), mesh);
  const Shell shell = to_shell(mesh, "left");
  CHECK(shell.points.size() == 4);
  CHECK(shell.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
  REQUIRE(shell.patches.size() == 1);
  CHECK(shell.patches[0].triangle_count == 2);
  SurfaceMesh quad;
  quad.add_face(quad.add_vertex({0, 0, 0}), quad.add_vertex({1, 0, 0}), quad.add_vertex({1, 1, 0}),
                quad.add_vertex({0, 1, 0}));
  CHECK_THROWS_WITH(to_shell(quad, "quad"), "mesh quad: a face is not a triangle");
}
