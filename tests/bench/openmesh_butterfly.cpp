// Subdivision, detection and transform beside OpenMesh's ModifiedButterflyT, in turn on one thread: points
// must be equal to 1e-14 of the diagonal, in whatever order OpenMesh numbers them. Built where OpenMesh is
// found.

#include <fmt/format.h>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/ModifiedButterFlyT.hh>
#include <cmath>
#include <cstdlib>

#include "bench/bench.hpp"
#include "meshcontour/read.hpp"
#include "meshcontour/wavelet.hpp"
#include "multires/triangle_tree.hpp"

using namespace meshcontour;

namespace {

struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using OpenMeshMesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;

constexpr double kEqual = 1e-14;  // of the diagonal
constexpr int kRounds = 5;

OpenMeshMesh mesh_of(const Shell& shell) {
  OpenMeshMesh mesh;
  std::vector<OpenMeshMesh::VertexHandle> vertices;
  for (const Point& p : shell.points) vertices.push_back(mesh.add_vertex({p.x(), p.y(), p.z()}));
  for (const auto& [a, b, c] : shell.triangles) mesh.add_face(vertices[a], vertices[b], vertices[c]);
  return mesh;
}

void subdivide(OpenMeshMesh& mesh, unsigned levels) {
  OpenMesh::Subdivider::Uniform::ModifiedButterflyT<OpenMeshMesh> subdivider;
  subdivider.attach(mesh);
  subdivider(levels);
  subdivider.detach();
}

// The largest distance of a point of one to the nearest point of the other.
double largest_distance(const std::vector<Point>& from, const std::vector<Point>& to) {
  std::vector<Triangle> single;
  for (Index v = 0; v < to.size(); ++v) single.push_back({v, v, v});
  const detail::TriangleTree tree(to, single);
  double squared = 0;
  for (const Point& p : from) squared = std::max(squared, tree.nearest(p).squared);
  return std::sqrt(squared);
}

bool compare(const std::string& file, unsigned levels) {
  Shell shell = read_model(file).shells.at(0);
  shell.patches = {{"", {}, 0, shell.triangles.size()}};
  const SubdivisionOptions options{.threads = 1};
  const Shell fine = subdivided(shell, levels, options);
  OpenMeshMesh theirs = mesh_of(shell);
  subdivide(theirs, levels);
  std::vector<Point> points;
  for (const auto v : theirs.vertices()) {
    points.push_back({theirs.point(v)[0], theirs.point(v)[1], theirs.point(v)[2]});
  }
  const double apart =
      std::max(largest_distance(points, fine.points), largest_distance(fine.points, points)) /
      bounding_box(fine).diagonal().norm();
  const WaveletTransform transform(shell, levels, options);
  std::vector<Point> details = fine.points;
  std::vector<bench::Contender> contenders = {{"OpenMesh",
                                               [&] {
                                                 OpenMeshMesh mesh = mesh_of(shell);
                                                 subdivide(mesh, levels);
                                               }},
                                              {"subdivide", [&] { subdivided(shell, levels, options); }},
                                              {"detect", [&] { find_subdivision(fine); }},
                                              {"analyse", [&] { transform.analyse(details); }},
                                              {"synthesise", [&] { transform.synthesise(details); }}};
  bench::alternate(contenders, kRounds);
  fmt::print("| {} | {} | {:.1e} |", file, fine.triangles.size(), apart);
  for (std::size_t i = 1; i < contenders.size(); ++i) {
    fmt::print(" {:.2f} |", contenders[i].median() / contenders[0].median());
  }
  fmt::print("\n");
  return points.size() == fine.points.size() && apart <= kEqual;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr, "usage: bench_openmesh_butterfly LEVELS MESH ...\n");
    return EXIT_FAILURE;
  }
  fmt::print("| mesh | triangles | apart / diagonal | subdivide | detect | analyse | synthesise |\n");
  fmt::print("|---|---:|---:|---:|---:|---:|---:|\n");
  bool equal = true;
  for (int i = 2; i < argc; ++i) equal = compare(argv[i], static_cast<unsigned>(std::atoi(argv[1]))) && equal;
  return equal ? EXIT_SUCCESS : EXIT_FAILURE;
}
