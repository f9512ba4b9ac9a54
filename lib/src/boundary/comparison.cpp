#include <algorithm>
#include <iterator>

#include "boundary/local_patch.hpp"
#include "boundary/patch_runs.hpp"
#include "boundary/valence.hpp"
#include "meshcontour/boundary.hpp"

namespace meshcontour {
namespace {

using VerticesByPatch = std::vector<std::vector<std::vector<Index>>>;

VerticesByPatch valence_vertices(const Model& model, unsigned threads) {
  VerticesByPatch result;
  for (const Shell& shell : model.shells) result.emplace_back(shell.patches.size());
  detail::WorkspacePool pool;
  detail::for_each_patch(model, threads, [&](std::size_t shell, std::size_t first, std::size_t last) {
    const Shell& source = model.shells[shell];
    pool.with([&](detail::Workspace& workspace) {
      for (std::size_t i = first; i < last; ++i) {
        result[shell][i] =
            detail::valence_boundary_vertices(source.patch_triangles(i), source.points.size(), workspace);
      }
    });
  });
  return result;
}

std::vector<Index> ends_of(std::span<const BoundaryEdge> edges) {
  std::vector<Index> ends;
  for (const auto& [from, to] : edges) ends.insert(ends.end(), {from, to});
  std::ranges::sort(ends);
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  return ends;
}

BoundaryCounts counts_of(const PatchBoundary& boundary) {
  return {boundary.edges.size(), boundary.vertex_count, boundary.loops.size()};
}

}  // namespace

std::vector<PatchComparison> compare_extractors(const Model& model, unsigned threads,
                                                const Measure& measure) {
  std::vector<Diagnostic> ignored;
  std::vector<ShellBoundary> halfedge, sorted;
  VerticesByPatch valence;
  measure("halfedge", [&] { halfedge = extract_boundaries(model, {Extractor::Halfedge, threads}, ignored); });
  measure("sorted", [&] { sorted = extract_boundaries(model, {Extractor::Sorted, threads}, ignored); });
  measure("valence", [&] { valence = valence_vertices(model, threads); });

  std::vector<std::size_t> first_row;
  std::size_t rows = 0;
  for (const Shell& shell : model.shells)
    first_row.push_back(std::exchange(rows, rows + shell.patches.size()));
  std::vector<PatchComparison> result(rows);
  detail::WorkspacePool pool;
  detail::for_each_patch(model, threads, [&](std::size_t shell, std::size_t first, std::size_t last) {
    const Shell& source = model.shells[shell];
    pool.with([&](detail::Workspace& workspace) {
      for (std::size_t i = first; i < last; ++i) {
        const PatchBoundary& h = halfedge[shell].patches[i];
        const PatchBoundary& s = sorted[shell].patches[i];
        const auto triangles = source.patch_triangles(i);
        const auto local = detail::number_locally(triangles, source.points.size(), workspace.slots);
        PatchComparison& row = result[first_row[shell] + i];
        row = {shell,
               i,
               triangles.size(),
               detail::is_orientable_manifold(source, local),
               counts_of(h),
               counts_of(s),
               valence[shell][i].size(),
               h.unheld_triangles,
               false};
        row.equal = h.edges == s.edges && h.loops == s.loops && valence[shell][i] == ends_of(s.edges);
      }
    });
  });
  return result;
}

}  // namespace meshcontour
