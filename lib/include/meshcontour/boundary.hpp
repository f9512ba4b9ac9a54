#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "meshcontour/model.hpp"
#include "meshcontour/shared_array.hpp"

namespace meshcontour {

/// An edge with exactly one triangle in its patch, directed as that triangle runs.
struct BoundaryEdge {
  Index from = 0, to = 0;
  friend auto operator<=>(const BoundaryEdge&, const BoundaryEdge&) = default;
};

/// Boundary edges joined head to tail, directed as the triangles run where these agree.
///
/// A closed loop starts with its smallest edge by (from, to); an open chain runs that edge forwards.
struct BoundaryLoop {
  SharedArray<Index> vertices;  ///< indices into Shell::points; the first is not repeated at the end
  bool closed = true;           ///< false: an open chain, found only where the input itself is broken
  friend bool operator==(const BoundaryLoop&, const BoundaryLoop&) = default;
};

/// The boundary of one patch.
struct PatchBoundary {
  SharedArray<BoundaryEdge> edges;     ///< sorted by (from, to)
  SharedArray<BoundaryLoop> loops;     ///< by their smallest edges, whatever the extractor and the threads
  std::size_t vertex_count = 0;        ///< boundary vertices, each once
  std::size_t nonmanifold_edges = 0;   ///< edges with three or more triangles; see extract_boundaries
  std::size_t unheld_triangles = 0;    ///< `Halfedge` only: triangles that the Surface_mesh could not hold
  std::size_t inconsistent_edges = 0;  ///< edges whose two triangles run the same way
  std::size_t touching_vertices = 0;   ///< vertices with more than two boundary edges
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
/// Linear in the triangles, but for sorting the boundary. Edges with four or more triangles, half of them
/// running each way, are counted only in patches of up to 200 triangles or with some other odd edge; they are
/// never boundary.
///
/// Findings (open chains, edges with three or more triangles, triangles that a
/// Surface_mesh could not hold) are appended to `diagnostics`, one line a kind and shell.
std::vector<ShellBoundary> extract_boundaries(const Model& model, const BoundaryOptions& options,
                                              std::vector<Diagnostic>& diagnostics);

/// Boundary edges of a patch, sorted by (from, to): edges with exactly one triangle. Triangles that repeat an
/// index are passed over.
std::vector<BoundaryEdge> sorted_boundary_edges(std::span<const Triangle> triangles);

/// Joins the boundary edges of a patch to loops.
///
/// At a vertex with more than two edges those are joined that bound the same triangle fan, so that a loop
/// never crosses from fan to fan. Triangles may run against each other: wherever an even number of edges
/// meets, they are joined. Where a fan ends at an edge with three or more triangles its end is joined to that
/// of another such fan; with an odd number of edges at a vertex one end stays open. Linear in the triangles
/// and edges, but for sorting what meets at a crowded vertex.
///
/// @param edges  as from sorted_boundary_edges for the same triangles.
std::vector<BoundaryLoop> trace_loops(std::span<const Triangle> triangles,
                                      std::span<const BoundaryEdge> edges);

/// Vertices that the report's criterion |N1(v)| != |L(v)| calls boundary: the number of neighbours differs
/// from the number of incident triangles. Sorted, each once. On a manifold patch these are the ends of the
/// boundary edges.
std::vector<Index> valence_boundary_vertices(std::span<const Triangle> triangles);

struct BoundaryCounts {
  std::size_t edges = 0, vertices = 0, loops = 0;
};

/// One patch as the three methods see it.
struct PatchComparison {
  std::size_t shell = 0, patch = 0;  ///< indices from 0
  std::size_t triangles = 0;
  bool manifold = false;  ///< an orientable manifold, however its triangles run: the methods must agree
  BoundaryCounts halfedge, sorted;
  std::size_t valence_vertices = 0;
  std::size_t unheld_triangles = 0;  ///< that the Surface_mesh could not hold
  bool equal = false;                ///< the same edges and loops, and their ends are the valence vertices

  /// Whether one of the methods must be wrong.
  bool disagrees() const { return manifold && !equal; }
};

/// Runs the work of one method, "halfedge", "sorted" or "valence"; for callers that take the time.
using Measure = std::function<void(std::string_view method, const std::function<void()>& work)>;

/// Compares both extractors and the valence criterion on every patch, in order of shell and patch.
///
/// On patches that are not orientable manifolds the methods may differ: the Surface_mesh leaves out
/// triangles, and the valence criterion takes vertices for boundary, or misses them, where fans meet.
std::vector<PatchComparison> compare_extractors(
    const Model& model, unsigned threads = 0,
    const Measure& measure = [](std::string_view, const std::function<void()>& work) { work(); });

}  // namespace meshcontour
