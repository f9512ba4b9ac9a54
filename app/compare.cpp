#include "compare.hpp"

#include <fmt/format.h>

namespace meshcontour::app {
namespace {

struct Total {
  std::size_t edges = 0, vertices = 0, loops = 0;

  void add(const BoundaryCounts& counts) {
    edges += counts.edges;
    vertices += counts.vertices;
    loops += counts.loops;
  }
};

std::string patch_name(const Model& model, const PatchComparison& patch) {
  return fmt::format("shell {} patch {}", printable(model.shells[patch.shell].id), patch.patch + 1);
}

// One line for each patch whose extractors differ; those that must not are failures.
void list_differences(const Model& model, const std::vector<PatchComparison>& patches,
                      const CommandLine& line, Outcome& outcome) {
  for (const PatchComparison& patch : patches) {
    if (patch.equal) continue;
    const std::string text =
        fmt::format("{}: halfedge {} edges in {} loops, sorted {} in {}, valence {} vertices",
                    patch_name(model, patch), patch.halfedge.edges, patch.halfedge.loops, patch.sorted.edges,
                    patch.sorted.loops, patch.valence_vertices);
    outcome.output += patch.manifold ? "DISAGREE " + text + '\n' : "not a manifold, " + text + '\n';
    if (!patch.disagrees()) continue;
    fail(ErrorCode::Internal, "the extractors disagree on " + patch_name(model, patch), {}, line, outcome);
  }
}

}  // namespace

void compare(const Model& model, const CommandLine& line, Outcome& outcome) {
  Timings timings;
  const Measure measure = [&](std::string_view method, const std::function<void()>& work) {
    timings.measure(method, work);
  };
  const std::vector<PatchComparison> patches = compare_extractors(model, line.job.boundary.threads, measure);
  Total halfedge, sorted;
  std::size_t manifold = 0, valence_vertices = 0, unheld = 0;
  for (const PatchComparison& patch : patches) {
    halfedge.add(patch.halfedge);
    sorted.add(patch.sorted);
    manifold += patch.manifold;
    valence_vertices += patch.valence_vertices;
    unheld += patch.unheld_triangles;
  }
  const auto row = [&](std::string_view method, const std::string& edges, std::size_t vertices,
                       const std::string& loops) {
    double wall = 0, cpu = 0;
    for (const StageTime& stage : timings.stages()) {
      if (stage.stage == method) wall = stage.wall_ms, cpu = stage.cpu_ms;
    }
    outcome.output += fmt::format("{:<10} {:>10} {:>10} {:>10} {:>10.2f} {:>10.2f}\n", method, edges,
                                  vertices, loops, wall, cpu);
  };
  outcome.output +=
      fmt::format("{} patches, {} of them orientable manifolds; {} triangles no Surface_mesh can hold\n",
                  patches.size(), manifold, unheld);
  outcome.output += fmt::format("{:<10} {:>10} {:>10} {:>10} {:>10} {:>10}\n", "extractor", "edges",
                                "vertices", "loops", "wall ms", "cpu ms");
  row("halfedge", fmt::format("{}", halfedge.edges), halfedge.vertices, fmt::format("{}", halfedge.loops));
  row("sorted", fmt::format("{}", sorted.edges), sorted.vertices, fmt::format("{}", sorted.loops));
  row("valence", "-", valence_vertices, "-");
  list_differences(model, patches, line, outcome);
}

}  // namespace meshcontour::app
