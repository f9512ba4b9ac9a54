// Simplified meshes beside those of other programs at equal numbers of triangles.
//
//   bench_simplify_quality FOLDER [MESH ...]          writes FOLDER/NAME.off and the numbers of triangles
//   simplify_peers.py FOLDER                          adds what other programs make of them
//   bench_simplify_quality --compare FOLDER [MESH ...]  prints the table
//
// Distances are measured from 60,000 points spread evenly over each surface, and its vertices, to the other.
// The L2 distance is the larger of the two root mean squares. A MESH file, which need not be a subdivided
// one, is put on a base mesh first.

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numeric>

#include "bench/bench.hpp"
#include "bench/subdivided_meshes.hpp"
#include "meshcontour/mesh_write.hpp"
#include "meshcontour/read.hpp"
#include "meshcontour/simplification.hpp"
#include "multires/triangle_tree.hpp"

using namespace meshcontour;

namespace {

constexpr std::size_t kSamples = 60'000;
constexpr std::size_t kShares[] = {50, 20, 10, 5};  // one of so many triangles stays
constexpr std::size_t kBaseTriangles = 300;
constexpr unsigned kLevels = 4;

struct Distance {
  double square_sum = 0, largest = 0;
};

// Evenly over the area, in a fixed order.
Distance one_sided(const Shell& from, const detail::TriangleTree& to) {
  std::vector<double> areas;
  for (const auto& [a, b, c] : from.triangles) {
    areas.push_back((from.points[b] - from.points[a]).cross(from.points[c] - from.points[a]).norm());
  }
  std::partial_sum(areas.begin(), areas.end(), areas.begin());
  Distance distance;
  std::size_t t = 0;
  for (std::size_t i = 0; i < kSamples; ++i) {
    const double at = (static_cast<double>(i) + 0.5) / kSamples * areas.back();
    while (areas[t] < at && t + 1 < areas.size()) ++t;
    double u = std::fmod(static_cast<double>(i) * 0.7548776662466927, 1.0);
    double v = std::fmod(static_cast<double>(i) * 0.5698402909980532, 1.0);
    if (u + v > 1) u = 1 - u, v = 1 - v;
    const auto& [a, b, c] = from.triangles[t];
    const Point p = (1 - u - v) * from.points[a] + u * from.points[b] + v * from.points[c];
    const double squared = to.nearest(p).squared;
    distance.square_sum += squared / kSamples;
    distance.largest = std::max(distance.largest, std::sqrt(squared));
  }
  for (const Triangle& triangle : from.triangles) {
    for (const Index v : triangle) {
      distance.largest = std::max(distance.largest, std::sqrt(to.nearest(from.points[v]).squared));
    }
  }
  return distance;
}

struct Quality {
  std::size_t triangles = 0;
  double l2 = 0, hausdorff = 0;  // per cent of the diagonal
};

Quality quality(const Shell& fine, const detail::TriangleTree& tree, const Shell& coarse) {
  const Distance there = one_sided(fine, {coarse.points, coarse.triangles}), back = one_sided(coarse, tree);
  const double scale = 100 / bounding_box(fine).diagonal().norm();
  return {coarse.triangles.size(), scale * std::sqrt(std::max(there.square_sum, back.square_sum)),
          scale * std::max(there.largest, back.largest)};
}

Shell read_shell(const std::filesystem::path& file) {
  Shell shell = read_model(file).shells.at(0);
  shell.patches = {{"", {}, 0, shell.triangles.size()}};
  shell.creases.clear();
  return shell;
}

std::vector<bench::SubdividedMesh> meshes_of(const std::vector<std::string>& files) {
  std::vector<bench::SubdividedMesh> meshes = bench::subdivided_meshes();
  for (const std::string& file : files) {
    meshes.push_back({std::filesystem::path(file).stem().string(),
                      [file] { return bench::projected(read_shell(file), kBaseTriangles, kLevels); }});
  }
  return meshes;
}

Shell simplified(Shell shell, SimplifyMethod method, std::size_t triangles) {
  SimplifyOptions options;
  options.method = method;
  options.goal = SimplifyGoal::Triangles;
  options.value = static_cast<double>(triangles);
  options.threads = 1;
  simplify_shell(shell, options, triangles);
  return shell;
}

std::string file_name(std::string name, std::size_t triangles, const std::string& kind) {
  std::ranges::replace(name, ' ', '-');
  return triangles == 0 ? name + ".off" : fmt::format("{}-{}-{}.off", name, triangles, kind);
}

void write_off(const Shell& shell, const std::filesystem::path& file) {
  Model model;
  model.shells = {shell};
  model.instances = {{}};
  StringSink sink;
  std::vector<Diagnostic> notes;
  write_mesh(MeshFormat::Off, model, {}, sink, notes);
  std::ofstream(file) << sink.text;
}

// Every peer gets as many triangles as the wavelets use.
void prepare(const std::filesystem::path& folder, const std::vector<bench::SubdividedMesh>& meshes) {
  std::ofstream list(folder / "list.txt");
  for (const auto& [name, make] : meshes) {
    const Shell fine = make();
    write_off(fine, folder / file_name(name, 0, ""));
    for (const std::size_t share : kShares) {
      const std::size_t count = fine.triangles.size() / share;
      list << file_name(name, 0, "") << ' ' << count << ' ' << file_name(name, count, "meshlab") << '\n';
    }
  }
}

void print_cell(const Quality& found, const Quality& ours) {
  fmt::print(" {:.4f} / {:.3f} | {:.2f} |", found.l2, found.hausdorff, ours.l2 / found.l2);
}

void compare(const std::filesystem::path& folder, const std::vector<bench::SubdividedMesh>& meshes) {
  fmt::print("| mesh | triangles | wavelet L2 / H | our qem | ratio | MeshLab | ratio | seconds |\n");
  fmt::print("|---|---:|---:|---:|---:|---:|---:|---:|\n");
  for (const auto& [name, make] : meshes) {
    const Shell fine = make();
    const detail::TriangleTree tree(fine.points, fine.triangles);
    for (const std::size_t share : kShares) {
      const std::size_t count = fine.triangles.size() / share;
      const double start = bench::cpu_seconds();
      const Shell coarse = simplified(fine, SimplifyMethod::Wavelet, count);
      const double seconds = bench::cpu_seconds() - start;
      const Quality ours = quality(fine, tree, coarse);
      fmt::print("| {} | {} | {:.4f} / {:.3f} |", name, ours.triangles, ours.l2, ours.hausdorff);
      print_cell(quality(fine, tree, simplified(fine, SimplifyMethod::Qem, count)), ours);
      const std::filesystem::path peer = folder / file_name(name, count, "meshlab");
      if (std::filesystem::exists(peer)) {
        print_cell(quality(fine, tree, read_shell(peer)), ours);
      } else {
        fmt::print(" - | - |");
      }
      fmt::print(" {:.2f} |\n", seconds);
      std::fflush(stdout);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  const bool table = !words.empty() && words.front() == "--compare";
  if (table) words.erase(words.begin());
  if (words.empty()) {
    fmt::print(stderr, "usage: bench_simplify_quality [--compare] FOLDER [MESH ...]\n");
    return EXIT_FAILURE;
  }
  const std::filesystem::path folder = words.front();
  std::filesystem::create_directories(folder);
  const auto meshes = meshes_of({words.begin() + 1, words.end()});
  if (table) {
    compare(folder, meshes);
  } else {
    prepare(folder, meshes);
  }
  return EXIT_SUCCESS;
}
