// How well an STL, which knows no patches, gives back the edges of the CAD model that it was made from:
// bench_feature_edges FOLDER, for every FOLDER/NAME.xml (or .xml.xz) with NAME.truth.json (or
// .truth.json.xz).
//
// Each model is written as binary STL, read again, and cut into patches at 30 degrees. An edge of the CAD
// model is sharp where the exact normals of its two faces differ by more than 30 degrees. Counted are mesh
// edges: those on sharp edges that were found, on patch borders or as creases, and those found elsewhere. A
// patch of the CAD model whose edges are all sharp must come back with the same loops.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "meshcontour/boundary.hpp"
#include "meshcontour/mesh_write.hpp"
#include "meshcontour/read.hpp"
#include "meshcontour/segmentation.hpp"
#include "support/packed.hpp"

using namespace meshcontour;
using Json = nlohmann::json;

namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kSharp = 30 * kDegree;

using Edge = std::array<Index, 2>;
using Loop = std::vector<Index>;

Edge undirected(Index a, Index b) {
  return {std::min(a, b), std::max(a, b)};
}

// Where the triangles at the edges of a shell are.
class EdgeUses {
 public:
  explicit EdgeUses(const Shell& shell) : shell_(shell) {
    for (std::size_t t = 0; t < shell.triangles.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        uses_.push_back({undirected(shell.triangles[t][k], shell.triangles[t][(k + 1) % 3]), t});
      }
    }
    std::ranges::sort(uses_);
  }

  std::vector<std::size_t> triangles(const Edge& edge) const {
    std::vector<std::size_t> result;
    auto use = std::ranges::lower_bound(uses_, std::pair(edge, std::size_t{0}));
    for (; use != uses_.end() && use->first == edge; ++use) result.push_back(use->second);
    return result;
  }

  // Angle of the exact normals of two triangles at both ends of their edge, the smaller one.
  double angle(std::size_t first, std::size_t second, const Edge& edge) const {
    double smallest = std::numbers::pi;
    for (const Index v : edge) {
      const double cosine = std::clamp(normal(first, v).dot(normal(second, v)), -1.0, 1.0);
      smallest = std::min(smallest, std::acos(cosine));
    }
    return smallest;
  }

 private:
  Vector normal(std::size_t triangle, Index v) const {
    const Triangle& t = shell_.triangles[triangle];
    for (std::size_t k = 0; k < 3 && !shell_.corner_normals.empty(); ++k) {
      const Vector& exact = shell_.corner_normals[3 * triangle + k];
      if (t[k] == v && exact.squaredNorm() > 0) return exact;
    }
    const Point &a = shell_.points[t[0]], &b = shell_.points[t[1]], &c = shell_.points[t[2]];
    return (b - a).cross(c - a).stableNormalized();
  }

  const Shell& shell_;
  std::vector<std::pair<Edge, std::size_t>> uses_;
};

// What the truth says of one shell, in its own vertices.
struct ShellTruth {
  std::vector<Edge> sharp, smooth;  // mesh edges on edges of the CAD model; free ones are sharp
  std::size_t sharp_cad_edges = 0;
  std::vector<bool> all_sharp;  // one a patch
};

ShellTruth truth_of(const Shell& shell, const Json& truth) {
  ShellTruth result;
  const EdgeUses uses(shell);
  std::set<Edge> sharp;
  for (const Json& edge : truth["edges"]) {
    if (!edge.contains("nodes") || edge["nodes"].is_null()) continue;
    const auto nodes = edge["nodes"].get<std::vector<Index>>();
    const std::set<std::size_t> faces = edge["faces"].get<std::set<std::size_t>>();
    const bool seam = faces.size() == 1;
    bool whole = nodes.size() > 1;
    for (std::size_t i = 1; i < nodes.size(); ++i) {
      const Edge chord = undirected(nodes[i - 1], nodes[i]);
      const auto triangles = uses.triangles(chord);
      const bool is_sharp = triangles.size() == 2 ? uses.angle(triangles[0], triangles[1], chord) > kSharp
                                                  : !seam || triangles.size() == 1;
      (is_sharp ? result.sharp : result.smooth).push_back(chord);
      if (is_sharp) sharp.insert(chord);
      whole = whole && is_sharp;
    }
    result.sharp_cad_edges += whole ? 1 : 0;
  }
  for (std::size_t p = 0; p < shell.patches.size(); ++p) result.all_sharp.push_back(true);
  for (std::size_t p = 0; p < shell.patches.size(); ++p) {
    for (const Triangle& t : shell.patch_triangles(p)) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Edge edge = undirected(t[k], t[(k + 1) % 3]);
        const auto around = uses.triangles(edge);
        const auto is_own = [&](std::size_t other) {
          return other >= shell.patches[p].first_triangle &&
                 other < shell.patches[p].first_triangle + shell.patches[p].triangle_count;
        };
        const bool inner = around.size() == 2 && is_own(around[0]) && is_own(around[1]);
        if (!inner && sharp.count(edge) == 0) result.all_sharp[p] = false;
      }
    }
  }
  return result;
}

// The loop from its smallest vertex on, in the direction of the smaller neighbour.
Loop canonical(Loop loop) {
  std::ranges::rotate(loop, std::ranges::min_element(loop));
  if (loop.size() > 2 && loop[1] > loop.back()) std::reverse(loop.begin() + 1, loop.end());
  return loop;
}

struct Figures {
  std::size_t triangles = 0, sharp = 0, found = 0, sharp_cad_edges = 0, detected = 0, false_on_smooth = 0,
              false_inside = 0, sharp_patches = 0, same_loops = 0;
};

std::vector<Loop> loops_of(const PatchBoundary& boundary, const std::vector<Index>& numbers) {
  std::vector<Loop> loops;
  for (const BoundaryLoop& loop : boundary.loops) {
    Loop mapped;
    for (const Index v : loop.vertices) mapped.push_back(numbers.empty() ? v : numbers[v]);
    loops.push_back(canonical(std::move(mapped)));
  }
  std::ranges::sort(loops);
  return loops;
}

// What was found in the STL.
struct Detected {
  std::set<Edge> edges;
  std::set<std::vector<Loop>> patches;
};

Detected detect(Model& model) {
  segment_model(model, {PatchSource::Angle, kSharp, 0});
  std::vector<Diagnostic> notes;
  const auto boundaries = extract_boundaries(model, {}, notes);
  Detected result;
  for (const PatchBoundary& patch : boundaries[0].patches) {
    for (const auto& [from, to] : patch.edges) result.edges.insert(undirected(from, to));
    result.patches.insert(loops_of(patch, {}));
  }
  for (const auto& [from, to] : model.shells[0].creases) result.edges.insert(undirected(from, to));
  return result;
}

// The numbers that the STL gives the vertices of an instance, whose triangles stand there from `first` on.
std::vector<Index> numbers_in_stl(const Model& model, const Instance& instance, const Shell& stl,
                                  std::size_t first) {
  const Shell& shell = model.shells[instance.shell];
  const bool mirrored = instance.placement.linear().determinant() < 0;
  std::vector<Index> numbers(shell.points.size(), 0);
  for (std::size_t t = 0; t < shell.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      numbers[shell.triangles[t][k]] = stl.triangles[first + t][mirrored ? (3 - k) % 3 : k];
    }
  }
  return numbers;
}

void compare(const Model& model, const Json& truth, const Shell& stl, const Detected& detected,
             Figures& figures) {
  std::vector<Diagnostic> notes;
  const auto boundaries = extract_boundaries(model, {}, notes);
  std::map<std::string, ShellTruth> truths;
  for (const Json& shell : truth["shell_list"]) {
    const auto own = std::ranges::find(model.shells, shell["id"].get<std::string>(), &Shell::id);
    if (own != model.shells.end()) truths.emplace(own->id, truth_of(*own, shell));
  }
  std::set<Edge> sharp, smooth;
  std::size_t first = 0;
  for (const Instance& instance : model.instances) {
    const Shell& shell = model.shells[instance.shell];
    const auto known = truths.find(shell.id);
    const std::vector<Index> numbers = numbers_in_stl(model, instance, stl, first);
    first += shell.triangles.size();
    if (known == truths.end()) continue;
    for (const auto& [a, b] : known->second.sharp) sharp.insert(undirected(numbers[a], numbers[b]));
    for (const auto& [a, b] : known->second.smooth) smooth.insert(undirected(numbers[a], numbers[b]));
    figures.sharp_cad_edges += known->second.sharp_cad_edges;
    for (std::size_t p = 0; p < shell.patches.size(); ++p) {
      if (!known->second.all_sharp[p] || boundaries[instance.shell].patches[p].loops.empty()) continue;
      ++figures.sharp_patches;
      figures.same_loops += detected.patches.count(loops_of(boundaries[instance.shell].patches[p], numbers));
    }
  }
  for (const Edge& edge : sharp) figures.found += detected.edges.count(edge);
  figures.sharp = sharp.size();
  figures.detected = detected.edges.size();
  for (const Edge& edge : detected.edges) {
    if (sharp.count(edge) > 0) continue;
    ++(smooth.count(edge) > 0 ? figures.false_on_smooth : figures.false_inside);
  }
}

std::string row(const std::string& name, const Figures& f) {
  const auto share = [](std::size_t part, std::size_t whole) {
    return whole == 0
               ? std::string("-")
               : fmt::format("{:.2f} %", 100.0 * static_cast<double>(part) / static_cast<double>(whole));
  };
  return fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", name, f.triangles, f.sharp_cad_edges,
                     f.sharp, share(f.found, f.sharp), f.false_on_smooth, f.false_inside, f.sharp_patches,
                     f.same_loops);
}

std::optional<Figures> study(const std::filesystem::path& stem) {
  const auto bytes = unpacked(stem.string() + ".xml"), truth = unpacked(stem.string() + ".truth.json");
  if (!bytes || !truth) return std::nullopt;
  const Model model = read_model(*bytes, stem.filename().string() + ".xml");
  StringSink file;
  std::vector<Diagnostic> notes;
  write_mesh(MeshFormat::Stl, model, {}, file, notes);
  Model stl = read_model(file.text, "model.stl");
  Figures figures;
  figures.triangles = stl.shells[0].triangles.size();
  std::size_t written = 0;
  for (const Instance& instance : model.instances) written += model.shells[instance.shell].triangles.size();
  if (written != figures.triangles) {
    fmt::print(stderr, "{}: {} of {} triangles fell away in single precision\n", stem.filename().string(),
               written - figures.triangles, written);
    return std::nullopt;
  }
  const Shell as_read = stl.shells[0];
  compare(model, Json::parse(*truth), as_read, detect(stl), figures);
  return figures;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 || !std::filesystem::is_directory(argv[1])) {
    fmt::print(stderr, "skipped: usage: bench_feature_edges FOLDER with NAME.xml and NAME.truth.json\n");
    return argc == 2 ? 0 : 64;
  }
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(argv[1])) {
    const std::string name = entry.path().filename().string();
    const std::size_t end = name.find(".truth.json");
    if (end != std::string::npos) names.insert(name.substr(0, end));
  }
  fmt::print(
      "| model | triangles | sharp CAD edges | their mesh edges | found | false, on smooth CAD edges | "
      "false, inside "
      "faces | patches with sharp edges only | of these with the same loops |\n|---|{}\n",
      "---:|---:|---:|---:|---:|---:|---:|---:|");
  Figures sum;
  for (const std::string& name : names) {
    try {
      const auto figures = study(std::filesystem::path(argv[1]) / name);
      if (!figures) continue;
      fmt::print("{}", row(name, *figures));
      std::fflush(stdout);
      for (auto member : {&Figures::triangles, &Figures::sharp, &Figures::found, &Figures::sharp_cad_edges,
                          &Figures::false_on_smooth, &Figures::false_inside, &Figures::sharp_patches,
                          &Figures::same_loops}) {
        sum.*member += *figures.*member;
      }
    } catch (const std::exception& error) {
      fmt::print(stderr, "{}: {}\n", name, error.what());
    }
  }
  fmt::print("{}", row("all", sum));
}
