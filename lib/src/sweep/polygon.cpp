// The one user of CGAL among the sweeps.

#include "sweep/polygon.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <utility>

namespace meshcontour::detail {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::size_t, Kernel>;
using FaceBase = CGAL::Constrained_triangulation_face_base_2<Kernel>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::No_constraint_intersection_tag>;

// False if two points are one, or two edges cross.
bool insert_polygon(std::span<const Eigen::Vector2d> points, Triangulation& triangulation) {
  std::vector<std::pair<Kernel::Point_2, std::size_t>> numbered;
  for (std::size_t i = 0; i < points.size(); ++i) {
    numbered.emplace_back(Kernel::Point_2(points[i].x(), points[i].y()), i);
  }
  triangulation.insert(numbered.begin(), numbered.end());
  if (triangulation.number_of_vertices() != points.size()) return false;
  std::vector<Triangulation::Vertex_handle> handles(points.size());
  for (const auto vertex : triangulation.finite_vertex_handles()) handles[vertex->info()] = vertex;
  try {
    for (std::size_t i = 0; i < handles.size(); ++i) {
      triangulation.insert_constraint(handles[i], handles[(i + 1) % handles.size()]);
    }
  } catch (const Triangulation::Intersection_of_constraints_exception&) {
    return false;
  }
  return true;
}

// The faces that can be reached from outside without crossing the polygon.
CGAL::Unique_hash_map<Triangulation::Face_handle, bool> outer_faces(const Triangulation& triangulation) {
  CGAL::Unique_hash_map<Triangulation::Face_handle, bool> outer(false);
  std::vector<Triangulation::Face_handle> stack = {triangulation.infinite_face()};
  outer[stack.back()] = true;
  while (!stack.empty()) {
    const Triangulation::Face_handle face = stack.back();
    stack.pop_back();
    for (int side = 0; side < 3; ++side) {
      const Triangulation::Face_handle neighbour = face->neighbor(side);
      if (outer[neighbour] || face->is_constrained(side)) continue;
      outer[neighbour] = true;
      stack.push_back(neighbour);
    }
  }
  return outer;
}

}  // namespace

std::vector<std::array<std::size_t, 3>> triangulate_polygon(std::span<const Eigen::Vector2d> points) {
  Triangulation triangulation;
  if (points.size() < 3 || !insert_polygon(points, triangulation)) return {};
  if (triangulation.dimension() < 2) return {};
  const auto outer = outer_faces(triangulation);
  std::vector<std::array<std::size_t, 3>> triangles;
  for (const auto face : triangulation.finite_face_handles()) {
    if (outer[face]) continue;
    triangles.push_back({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  }
  if (triangles.size() + 2 != points.size()) return {};
  return triangles;
}

}  // namespace meshcontour::detail
