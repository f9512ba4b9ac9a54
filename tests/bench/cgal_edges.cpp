// An STL to its patch edges by CGAL's own functions, for compare_stl.py: bench_cgal_edges IN.stl OUT.csv

#include <CGAL/IO/STL.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <fmt/compile.h>
#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <vector>

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
namespace processing = CGAL::Polygon_mesh_processing;

Mesh read(const char* name) {
  std::vector<Kernel::Point_3> points;
  std::vector<std::array<std::size_t, 3>> triangles;
  std::ifstream in(name, std::ios::binary);
  if (!CGAL::IO::read_STL(in, points, triangles)) throw std::runtime_error("cannot read the STL");
  processing::merge_duplicate_points_in_polygon_soup(points, triangles);
  processing::orient_polygon_soup(points, triangles);
  Mesh mesh;
  processing::polygon_soup_to_polygon_mesh(points, triangles, mesh);
  return mesh;
}

std::size_t write_edges(const Mesh& mesh, const Mesh::Property_map<Mesh::Face_index, std::size_t>& patch,
                        const char* name) {
  fmt::memory_buffer text;
  std::size_t count = 0;
  for (const auto edge : mesh.edges()) {
    const auto h = mesh.halfedge(edge);
    const auto left = mesh.face(h), right = mesh.face(mesh.opposite(h));
    if (left.is_valid() && right.is_valid() && patch[left] == patch[right]) continue;
    ++count;
    for (const auto end : {mesh.source(h), mesh.target(h)}) {
      const auto& p = mesh.point(end);
      fmt::format_to(std::back_inserter(text), FMT_COMPILE("{},{},{},{}\n"), static_cast<unsigned>(end),
                     p.x(), p.y(), p.z());
    }
  }
  std::ofstream(name, std::ios::binary).write(text.data(), static_cast<std::streamsize>(text.size()));
  return count;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 64;
  try {
    Mesh mesh = read(argv[1]);
    auto sharp = mesh.add_property_map<Mesh::Edge_index, bool>("e:sharp", false).first;
    processing::detect_sharp_edges(mesh, 30, sharp);
    auto patch = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:patch", 0).first;
    processing::connected_components(mesh, patch, CGAL::parameters::edge_is_constrained_map(sharp));
    fmt::print("{}\n", write_edges(mesh, patch, argv[2]));
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_cgal_edges: {}\n", error.what());
    return 70;
  }
}
