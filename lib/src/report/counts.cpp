#include "meshcontour/report.hpp"

namespace meshcontour {
namespace {

std::uint64_t boundary_vertices(const Shell& shell, const ShellBoundary& boundary) {
  std::vector<bool> on_boundary(shell.points.size(), false);
  std::uint64_t count = 0;
  for (const PatchBoundary& patch : boundary.patches) {
    for (const BoundaryEdge& edge : patch.edges) {
      for (const Index v : {edge.from, edge.to}) {
        if (!on_boundary[v]) ++count;
        on_boundary[v] = true;
      }
    }
  }
  return count;
}

}  // namespace

Counts counts_of(const Model& model, std::span<const ShellBoundary> boundaries,
                 std::span<const Contour> contours) {
  Counts counts;
  counts.shells = model.shells.size();
  counts.instances = model.instances.size();
  for (const Shell& shell : model.shells) {
    counts.patches += shell.patches.size();
    counts.vertices += shell.points.size();
    counts.triangles += shell.triangles.size();
  }
  for (std::size_t s = 0; s < boundaries.size(); ++s) {
    counts.boundary_vertices += boundary_vertices(model.shells[s], boundaries[s]);
    for (const PatchBoundary& patch : boundaries[s].patches) {
      counts.boundary_edges += patch.edges.size();
      counts.loops += patch.loops.size();
      for (const BoundaryLoop& loop : patch.loops) counts.open_chains += loop.closed ? 0 : 1;
    }
  }
  for (const Contour& contour : contours) {
    counts.segments += contour.segments.size();
    count_kinds(contour, counts);
  }
  return counts;
}

void count_kinds(const Contour& contour, Counts& counts) {
  for (const Segment& segment : contour.segments) {
    if (const auto* arc = std::get_if<CircularArc>(&segment.curve)) {
      ++(arc->full() ? counts.circles : counts.arcs);
    } else if (std::holds_alternative<LineSegment>(segment.curve)) {
      ++counts.lines;
    } else {
      ++(std::holds_alternative<EllipticalArc>(segment.curve) ? counts.ellipses : counts.splines);
    }
  }
}

}  // namespace meshcontour
