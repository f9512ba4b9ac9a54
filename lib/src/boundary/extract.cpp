#include <fmt/format.h>

#include <algorithm>

#include "base/large_array.hpp"
#include "boundary/edge_filter.hpp"
#include "boundary/halfedge.hpp"
#include "boundary/loops.hpp"
#include "boundary/numbering.hpp"
#include "boundary/patch_runs.hpp"
#include "boundary/small_patch.hpp"
#include "meshcontour/boundary.hpp"

namespace meshcontour {
namespace {

PatchBoundary sorted_boundary(const Shell& shell, std::size_t patch, detail::Workspace& workspace) {
  const auto triangles = shell.patch_triangles(patch);
  PatchBoundary boundary;
  if (detail::small_patch_boundary(triangles, shell.points.size(), workspace, boundary)) return boundary;
  const detail::EdgeCensus& census = detail::census_of_edges(triangles, shell.points.size(), workspace);
  detail::LoopTrace trace = detail::trace_loops(triangles, census.boundary, shell.points.size(), workspace);
  boundary.edges = workspace.edge_arrays.make(workspace.census.boundary);
  boundary.loops = workspace.loop_arrays.make(trace.loops);
  boundary.vertex_count = trace.vertices;
  boundary.nonmanifold_edges = census.nonmanifold;
  boundary.inconsistent_edges = census.inconsistent;
  boundary.touching_vertices = trace.touching_vertices;
  return boundary;
}

// Adds up what the patches of one shell report, with the first patch as the place.
class Finding {
 public:
  Finding(Diagnostic::Severity severity, const char* message) : found_{severity, message, {}, 0} {}

  void add(const Shell& shell, std::size_t patch, std::size_t count) {
    if (count == 0) return;
    if (found_.count == 0)
      found_.spot.element = fmt::format("shell {}, patch {}", printable(shell.id), patch + 1);
    found_.count += count;
  }

  void report(std::vector<Diagnostic>& diagnostics) const {
    if (found_.count > 0) diagnostics.push_back(found_);
  }

 private:
  Diagnostic found_;
};

void report(const Shell& shell, const ShellBoundary& boundary, std::vector<Diagnostic>& diagnostics) {
  using enum Diagnostic::Severity;
  Finding open(Warning, "boundary chain does not close");
  Finding nonmanifold(Warning, "edge with three or more triangles in its patch");
  Finding inconsistent(Warning, "edge whose two triangles run the same way");
  Finding touching(Note, "vertex at which boundary loops touch");
  Finding unheld(Warning, "triangle that a surface mesh cannot hold");
  for (std::size_t i = 0; i < boundary.patches.size(); ++i) {
    const PatchBoundary& patch = boundary.patches[i];
    const auto is_open = [](const BoundaryLoop& loop) { return !loop.closed; };
    open.add(shell, i, static_cast<std::size_t>(std::ranges::count_if(patch.loops, is_open)));
    nonmanifold.add(shell, i, patch.nonmanifold_edges);
    inconsistent.add(shell, i, patch.inconsistent_edges);
    touching.add(shell, i, patch.touching_vertices);
    unheld.add(shell, i, patch.unheld_triangles);
  }
  for (const Finding* finding : {&open, &nonmanifold, &inconsistent, &touching, &unheld})
    finding->report(diagnostics);
}

}  // namespace

std::vector<ShellBoundary> extract_boundaries(const Model& model, const BoundaryOptions& options,
                                              std::vector<Diagnostic>& diagnostics) {
  std::vector<ShellBoundary> boundaries(model.shells.size());
  for (std::size_t i = 0; i < model.shells.size(); ++i) {
    const Shell& shell = model.shells[i];
    if (shell.points.size() >= detail::kVertexLimit) {
      throw Error(ErrorCode::OutOfMemory, fmt::format("shell {}: 2^31 points or more", printable(shell.id)));
    }
    detail::reserve_large(boundaries[i].patches, shell.patches.size());
    boundaries[i].patches.resize(shell.patches.size());
  }
  detail::WorkspacePool pool;
  detail::for_each_patch(model, options.threads, [&](std::size_t shell, std::size_t first, std::size_t last) {
    const auto extract =
        options.extractor == Extractor::Halfedge ? detail::halfedge_boundary : sorted_boundary;
    pool.with([&](detail::Workspace& workspace) {
      for (std::size_t patch = first; patch < last; ++patch) {
        boundaries[shell].patches[patch] = extract(model.shells[shell], patch, workspace);
      }
    });
  });
  for (std::size_t i = 0; i < model.shells.size(); ++i) report(model.shells[i], boundaries[i], diagnostics);
  return boundaries;
}

}  // namespace meshcontour
