// Boundary loops: ours beside add_face and border walk with CGAL and, where it is installed, OpenMesh, beside
// sorting all edges, and copying the indices.
//
// usage: bench_boundary [rounds] [case...]

#include <fmt/format.h>
#include <sys/mman.h>

#if __has_include(<OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>)
#define MESHCONTOUR_HAS_OPENMESH
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#endif

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <numeric>

#include "bench/bench.hpp"
#include "meshcontour/boundary.hpp"
#include "meshcontour/surface_mesh.hpp"
#include "support/meshes.hpp"

using namespace meshcontour;

namespace {

// What every contender must agree on.
struct Answer {
  std::size_t edges = 0, loops = 0;
  std::uint64_t vertex_sum = 0;  // over all loops, with the vertices' places in edges
  friend bool operator==(const Answer&, const Answer&) = default;
};

Answer answer_of(const Model& model, Extractor extractor) {
  std::vector<Diagnostic> diagnostics;
  Answer answer;
  const auto boundaries = extract_boundaries(model, {extractor, 1}, diagnostics);
  for (const PatchBoundary& patch : boundaries[0].patches) {
    answer.edges += patch.edges.size();
    answer.loops += patch.loops.size();
    for (const auto& loop : patch.loops) {
      answer.vertex_sum = std::accumulate(loop.vertices.begin(), loop.vertices.end(), answer.vertex_sum);
    }
  }
  return answer;
}

// Surface_mesh::add_face for every triangle, then the border halfedges followed by next().
class AddFaceAndWalk {
 public:
  explicit AddFaceAndWalk(const Shell& shell) : shell_(shell), local_(shell.points.size(), kNone) {}

  Answer run() {
    Answer answer;
    for (std::size_t i = 0; i < shell_.patches.size(); ++i) add_patch(i, answer);
    return answer;
  }

 private:
  static constexpr Index kNone = 0xffffffff;

  SurfaceMesh::Vertex_index vertex(Index v, SurfaceMesh& mesh) {
    if (local_[v] == kNone) {
      local_[v] = static_cast<Index>(vertices_.size());
      vertices_.push_back(v);
      const Point& p = shell_.points[v];
      mesh.add_vertex({p.x(), p.y(), p.z()});
    }
    return SurfaceMesh::Vertex_index(local_[v]);
  }

  void add_patch(std::size_t patch, Answer& answer) {
    const auto triangles = shell_.patch_triangles(patch);
    const auto count = static_cast<SurfaceMesh::size_type>(triangles.size());
    SurfaceMesh mesh;
    mesh.reserve(count / 2 + 2, 3 * count / 2 + 2, count);
    for (const auto& [a, b, c] : triangles) mesh.add_face(vertex(a, mesh), vertex(b, mesh), vertex(c, mesh));
    std::vector<bool> seen(mesh.number_of_halfedges());
    for (const auto start : mesh.halfedges()) {
      if (!mesh.is_border(start) || seen[start]) continue;
      ++answer.loops;
      for (auto h = start; !seen[h]; h = mesh.next(h)) {
        seen[h] = true;
        ++answer.edges;
        answer.vertex_sum += vertices_[mesh.target(h)];
      }
    }
    for (const Index v : vertices_) local_[v] = kNone;
    vertices_.clear();
  }

  const Shell& shell_;
  std::vector<Index> local_, vertices_;
};

#ifdef MESHCONTOUR_HAS_OPENMESH
// The same with OpenMesh, with room for everything.
class OpenMeshAndWalk {
 public:
  explicit OpenMeshAndWalk(const Shell& shell) : shell_(shell), local_(shell.points.size()) {}

  Answer run() {
    Answer answer;
    for (std::size_t i = 0; i < shell_.patches.size(); ++i) add_patch(i, answer);
    return answer;
  }

 private:
  struct Traits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    VertexAttributes(0);
    HalfedgeAttributes(OpenMesh::Attributes::PrevHalfedge);
    FaceAttributes(0);
  };
  using Mesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;

  void add_patch(std::size_t patch, Answer& answer) {
    const auto triangles = shell_.patch_triangles(patch);
    Mesh mesh;
    mesh.reserve(triangles.size() / 2 + 2, 3 * triangles.size() / 2 + 2, triangles.size());
    const auto vertex = [&](Index v) {
      if (!local_[v].is_valid()) {
        const Point& p = shell_.points[v];
        local_[v] = mesh.add_vertex({p.x(), p.y(), p.z()});
        vertices_.push_back(v);
      }
      return local_[v];
    };
    for (const auto& [a, b, c] : triangles) mesh.add_face(vertex(a), vertex(b), vertex(c));
    std::vector<bool> seen(mesh.n_halfedges());
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const OpenMesh::HalfedgeHandle start(static_cast<int>(i));
      if (!mesh.is_boundary(start) || seen[i]) continue;
      ++answer.loops;
      for (auto h = start; !seen[static_cast<std::size_t>(h.idx())]; h = mesh.next_halfedge_handle(h)) {
        seen[static_cast<std::size_t>(h.idx())] = true;
        ++answer.edges;
        answer.vertex_sum += vertices_[static_cast<std::size_t>(mesh.to_vertex_handle(h).idx())];
      }
    }
    for (const Index v : vertices_) local_[v].invalidate();
    vertices_.clear();
  }

  const Shell& shell_;
  std::vector<OpenMesh::VertexHandle> local_;
  std::vector<Index> vertices_;
};
#endif

// The number of edges that occur once in a sorted list of all of them.
std::size_t sort_all_edges(const Shell& shell) {
  std::size_t once = 0;
  std::vector<std::uint64_t> keys;
  for (std::size_t i = 0; i < shell.patches.size(); ++i) {
    keys.clear();
    for (const Triangle& t : shell.patch_triangles(i)) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Index from = t[k], to = t[k == 2 ? 0 : k + 1];
        keys.push_back(std::uint64_t{std::min(from, to)} << 32 | std::max(from, to));
      }
    }
    std::ranges::sort(keys);
    for (std::size_t k = 0; k < keys.size();) {
      std::size_t end = k + 1;
      while (end < keys.size() && keys[end] == keys[k]) ++end;
      once += end - k == 1 ? 1 : 0;
      k = end;
    }
  }
  return once;
}

// Copies the indices into memory that was never touched.
std::uint64_t copy_indices(const Shell& shell) {
  const std::size_t bytes = shell.triangles.size() * sizeof(Triangle);
  void* copy = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (copy == MAP_FAILED) std::abort();
  std::memcpy(copy, shell.triangles.data(), bytes);
  const std::uint64_t sample = static_cast<const Index*>(copy)[bytes / 8];
  munmap(copy, bytes);
  return sample;
}

// Squares with a hole in every 16th of every second row and column.
Model grid(Index triangles, bool shuffled) {
  const auto side = static_cast<Index>(std::sqrt(triangles / 2.0));
  const meshes::Mesh mesh = meshes::grid(side, side, 8);
  return meshes::model({shuffled ? meshes::shuffled(mesh, 1) : mesh});
}

// Bands of 17 squares, one row of a cylinder each, sharing the vertices between them.
Model bands(Index count) {
  Model model = meshes::model({meshes::cylinder(17, count)});
  std::vector<Patch>& patches = model.shells[0].patches;
  patches.clear();
  for (Index i = 0; i < count; ++i) patches.push_back({"", {}, 34 * std::size_t{i}, 34});
  return model;
}

bool run(const std::string& name, const Model& model, int rounds) {
  const Shell& shell = model.shells[0];
  AddFaceAndWalk add_face(shell);
  const Answer expected = answer_of(model, Extractor::Sorted);
  if (add_face.run() != expected || sort_all_edges(shell) != expected.edges ||
      answer_of(model, Extractor::Halfedge) != expected) {
    fmt::print("{}: the answers differ\n", name);
    return false;
  }
  std::vector<Diagnostic> diagnostics;
  std::uint64_t sink = 0;
#ifdef MESHCONTOUR_HAS_OPENMESH
  OpenMeshAndWalk openmesh(shell);
  if (openmesh.run() != expected) {
    fmt::print("{}: OpenMesh's answer differs\n", name);
    return false;
  }
#endif
  std::vector<bench::Contender> contenders = {
      {"sorted",
       [&] {
         extract_boundaries(model, {Extractor::Sorted, 1}, diagnostics);
       }},
      {"CGAL add_face + walk", [&] { sink += add_face.run().loops; }},
#ifdef MESHCONTOUR_HAS_OPENMESH
      {"OpenMesh add_face + walk", [&] { sink += openmesh.run().loops; }},
#endif
      {"sort all edges", [&] { sink += sort_all_edges(shell); }},
      {"copy of the indices", [&] { sink += copy_indices(shell); }},
      {"halfedge", [&] {
         extract_boundaries(model, {Extractor::Halfedge, 1}, diagnostics);
       }}};
  // Short work is repeated, so that it is not the state of the caches after another's turn that is measured.
  const std::size_t repeats = 1 + 300'000 / shell.triangles.size();
  for (bench::Contender& contender : contenders) {
    contender.run = [run = contender.run, repeats] {
      for (std::size_t i = 0; i < repeats; ++i) run();
    };
  }
  bench::alternate(contenders, rounds);
  const double ours = contenders[0].median();
  const auto triangles = static_cast<double>(repeats * shell.triangles.size());
  for (const bench::Contender& contender : contenders) {
    fmt::print("| {} | {} | {:.2f} | {:.2f} |\n", name, contender.name, triangles * 1e-6 / contender.median(),
               contender.median() / ours);
  }
  std::fflush(stdout);
  return sink != 0;
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 5;
  const std::vector<std::string> wanted(argv + std::min(argc, 2), argv + argc);
  const auto is_wanted = [&](const std::string& name) {
    return wanted.empty() || std::ranges::find(wanted, name) != wanted.end();
  };
  bool good = true;
  fmt::print("| case | method | Mtriangles/s | time / ours |\n|---|---|---|---|\n");
  const auto bench_case = [&](const std::string& name, const std::function<Model()>& make) {
    if (is_wanted(name)) good = run(name, make(), rounds) && good;
  };
  bench_case("grid-1e4", [] { return grid(10'000, false); });
  bench_case("grid-1e4-shuffled", [] { return grid(10'000, true); });
  bench_case("bands-1e5", [] { return bands(100'000); });
  bench_case("grid-1e6", [] { return grid(1'000'000, false); });
  bench_case("grid-1e6-shuffled", [] { return grid(1'000'000, true); });
  bench_case("grid-1e7", [] { return grid(10'000'000, false); });
  bench_case("grid-1e7-shuffled", [] { return grid(10'000'000, true); });
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
