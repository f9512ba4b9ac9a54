#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "meshcontour/model.hpp"

namespace meshcontour {

/// An edge with exactly one triangle in its patch, directed as that triangle runs.
struct BoundaryEdge {
  Index from = 0, to = 0;
  friend auto operator<=>(const BoundaryEdge&, const BoundaryEdge&) = default;
};

/// Boundary edges joined head to tail, directed as the triangles run where these agree.
struct BoundaryLoop {
  std::vector<Index> vertices;  ///< indices into Shell::points; the first is not repeated at the end
  bool closed = true;           ///< false: an open chain, found only where the input itself is broken
};

/// The boundary of one patch.
struct PatchBoundary {
  std::vector<BoundaryEdge> edges;  ///< sorted by (from, to)
  std::vector<BoundaryLoop> loops;  ///< in a fixed order, independent of the extractor and of the threads
  std::size_t vertex_count = 0;     ///< boundary vertices, each once
  std::size_t nonmanifold_edges = 0;  ///< edges with three or more triangles
  std::size_t unheld_triangles = 0;   ///< `Halfedge` only: triangles that the Surface_mesh could not hold
};

/// The boundaries of a shell's patches, in patch order.
struct ShellBoundary {
  std::vector<PatchBoundary> patches;
};

/// How boundary edges are found.
enum class Extractor {
  Sorted,    ///< fingerprint filter and a small sort: any input, linear
  Halfedge,  ///< border halfedges of a CGAL::Surface_mesh
};

struct BoundaryOptions {
  Extractor extractor = Extractor::Sorted;
  unsigned threads = 0;  ///< 0: one per processor
};

/// The boundaries of every shell of the model, parallel to Model::shells.
///
/// Linear in the triangles. Findings (open chains, edges with three or more triangles, triangles that a Surface_mesh
/// could not hold) are appended to `diagnostics`, one line a kind and shell.
std::vector<ShellBoundary> extract_boundaries(const Model& model, const BoundaryOptions& options,
                                              std::vector<Diagnostic>& diagnostics);

/// Boundary edges of a patch, sorted by (from, to): edges with exactly one triangle. Degenerate triangles (a repeated
/// index) count their one real edge twice, so they add nothing.
std::vector<BoundaryEdge> sorted_boundary_edges(std::span<const Triangle> triangles);

/// Joins the boundary edges of a patch to loops.
///
/// At a vertex with several outgoing edges the successor is the one in the same triangle fan, so that a loop never
/// crosses from fan to fan. Linear in the triangles at such vertices plus the edges.
///
/// @param edges  as from sorted_boundary_edges for the same triangles.
std::vector<BoundaryLoop> trace_loops(std::span<const Triangle> triangles, std::span<const BoundaryEdge> edges);

/// Vertices that the report's criterion |N1(v)| != |L(v)| calls boundary: the number of neighbours differs from the
/// number of incident triangles. Sorted, each once. On a manifold patch these are the ends of the boundary edges.
std::vector<Index> valence_boundary_vertices(std::span<const Triangle> triangles);

}  // namespace meshcontour
