// Real models with known counts, and hostile ones with known loops; both live beside the checkout.

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "meshcontour/boundary.hpp"
#include "meshcontour/read.hpp"
#include "support/catch.hpp"
#include "support/shared.hpp"

using namespace meshcontour;

namespace {

namespace fs = std::filesystem;

// Nothing when xz is not there to unpack it.
std::string unpacked(const fs::path& file) {
  std::string bytes;
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(("xz -dc '" + file.string() + "'").c_str(), "r"),
                                                   pclose);
  std::array<char, 1 << 16> part;
  while (pipe) {
    const std::size_t count = std::fread(part.data(), 1, part.size(), pipe.get());
    if (count == 0) break;
    bytes.append(part.data(), count);
  }
  return bytes;
}

Model read_any(const fs::path& file) {
  if (file.extension() != ".xz") return read_model(file);
  const std::string bytes = unpacked(file);
  return bytes.empty() ? Model{} : read_model(bytes, file.stem().string());
}

std::vector<std::size_t> lengths(const PatchBoundary& boundary) {
  std::vector<std::size_t> result;
  for (const BoundaryLoop& loop : boundary.loops) result.push_back(loop.vertices.size());
  std::ranges::sort(result);
  return result;
}

// Loop lengths by patch over all shells, those of open chains negative.
std::vector<std::vector<int>> loops_by_patch(const Model& model, Extractor extractor) {
  std::vector<Diagnostic> diagnostics;
  std::vector<std::vector<int>> result;
  for (const auto boundaries = extract_boundaries(model, {extractor, 0}, diagnostics);
       const ShellBoundary& shell : boundaries) {
    for (const PatchBoundary& patch : shell.patches) {
      auto& loops = result.emplace_back();
      for (const BoundaryLoop& loop : patch.loops) {
        loops.push_back(static_cast<int>(loop.vertices.size()) * (loop.closed ? 1 : -1));
      }
      std::ranges::sort(loops);
    }
  }
  return result;
}

void check_model(const Model& model, const nlohmann::json& expected, Extractor extractor) {
  std::vector<Diagnostic> diagnostics;
  const auto boundaries = extract_boundaries(model, {extractor, 0}, diagnostics);
  CHECK(diagnostics.empty());
  std::map<std::string, std::size_t> shells;
  for (std::size_t i = 0; i < model.shells.size(); ++i) shells[model.shells[i].id] = i;
  std::size_t vertices = 0, edges = 0;
  for (const auto& row : expected.at("per_patch")) {
    const std::size_t shell = shells.at(row[0].get<std::string>()), patch = row[1].get<std::size_t>() - 1;
    const PatchBoundary& boundary = boundaries.at(shell).patches.at(patch);
    INFO("shell " << row[0] << ", patch " << patch + 1);
    CHECK(model.shells[shell].patches[patch].triangle_count == row[2].get<std::size_t>());
    CHECK(lengths(boundary) == row[3].get<std::vector<std::size_t>>());
    CHECK(boundary.vertex_count == boundary.edges.size());
    edges += boundary.edges.size();
  }
  for (std::size_t i = 0; i < boundaries.size(); ++i) {
    std::vector<bool> seen(model.shells[i].points.size());
    for (const PatchBoundary& patch : boundaries[i].patches) {
      for (const auto& [from, to] : patch.edges) seen[from] = seen[to] = true;
    }
    vertices += static_cast<std::size_t>(std::ranges::count(seen, true));
  }
  CHECK(edges == expected.at("boundary_edges").get<std::size_t>());
  CHECK(vertices == expected.at("boundary_vertices").get<std::size_t>());
}

using Loops = std::vector<std::vector<int>>;

struct Hostile {
  const char* file;
  Loops loops;
};

const Loops kCube(6, {4}), kSquare = {{4}};

// What is written beside the files; triangles that occur twice are dropped by the reader, mirrored ones kept.
const std::vector<Hostile> kHostile = {
    {"c01_duplicate_triangle.xml", kSquare},
    {"c02_duplicate_rotated.xml", kSquare},
    {"c03_duplicate_reversed.xml", {{-3}}},
    {"c05_all_flipped.xml", kCube},
    {"c06_bowtie.xml", {{3, 3}}},
    {"c07_hole_touches_outer.xml", {{9}}},
    {"c09_fin_three_triangles.xml", {{-3, 4}}},
    {"c10_fin_across_patches.xml", {{3}, {3}, {3}}},
    {"c11_moebius.xml", {{24}}},
    {"c13_degenerate_index.xml", kSquare},
    {"c14_degenerate_all_same.xml", kSquare},
    {"c15_zero_area.xml", kSquare},
    {"c17_isolated_vertices.xml", kSquare},
    {"c18_empty_facets.xml", {{4}, {4}, {4}, {}, {4}, {4}, {4}}},
    {"c22_single_triangle.xml", {{3}}},
    {"c23_closed_tetra.xml", {{}}},
    {"c25_two_components.xml", {{4, 4}}},
    {"c26_component_closed_plus_open.xml", kSquare},
    {"c27_triangle_soup.xml", Loops(6, {3, 3})},
    {"c29_coincident_loop_points.xml", {{6}}},
    {"c30_all_points_equal.xml", kSquare},
    {"c31_collinear_model.xml", kSquare},
    {"c33_huge_scale.xml", kCube},
    {"c34_far_offset.xml", kCube},
    {"c35_flat_model.xml", kSquare},
    {"c37_annulus.xml", {{16, 16}}},
    {"c38_66000_vertices.xml", {{66000}}},
    {"c39_fan_20000.xml", {{20000}}},
    {"c41_3000_loops_one_patch.xml", {std::vector<int>(3000, 3)}},
    {"c42_key_collision.xml", {{4}, {3}}},
    {"c43_pinched_tube.xml", {{4, 4}}},
    {"c45_opposite_coincident_faces.xml", {{4}, {4}}},
};

// The halfedge mesh holds the others whole.
constexpr std::array kNotHeld = {"c03_duplicate_reversed.xml", "c09_fin_three_triangles.xml",
                                 "c11_moebius.xml"};

}  // namespace

TEST_CASE("extract_boundaries: real models have the loops that an independent program found",
          "[boundary][shared]") {
  MESHCONTOUR_NEEDS_SHARED("models/expected.json");
  nlohmann::json expected;
  std::ifstream(shared_dir() / "models/expected.json") >> expected;
  for (const auto& [file, counts] : expected.items()) {
    INFO(file);
    const Model model = read_any(shared_dir() / "models" / file);
    if (model.shells.empty()) continue;
    check_model(model, counts, Extractor::Sorted);
    check_model(model, counts, Extractor::Halfedge);
    for (const PatchComparison& row : compare_extractors(model)) {
      CHECK(row.manifold);
      CHECK(row.equal);
    }
  }
}

TEST_CASE("extract_boundaries: hostile models have the loops that are stated for them",
          "[boundary][shared]") {
  MESHCONTOUR_NEEDS_SHARED("hostile/EXPECT.md");
  for (const Hostile& hostile : kHostile) {
    INFO(hostile.file);
    const Model model = read_model(shared_dir() / "hostile" / hostile.file);
    CHECK(loops_by_patch(model, Extractor::Sorted) == hostile.loops);
    if (!std::ranges::count(kNotHeld, std::string_view(hostile.file))) {
      CHECK(loops_by_patch(model, Extractor::Halfedge) == hostile.loops);
    }
    for (const PatchComparison& row : compare_extractors(model)) CHECK_FALSE(row.disagrees());
  }
}
