#pragma once

#include <cstddef>
#include <vector>

#include "meshcontour/model.hpp"

namespace meshcontour {

/// What clean_shell found; in the order in which it works.
struct CleaningCounts {
  std::size_t unused_points = 0;  ///< no triangle names them; they stay, so that indices keep their meaning
  std::size_t degenerate_triangles = 0;     ///< named a point twice; removed
  std::size_t duplicate_triangles = 0;      ///< had the points of an earlier one, in any order; removed
  std::size_t turned_triangles = 0;         ///< ran against their component; turned round
  std::size_t unorientable_components = 0;  ///< as a Moebius strip; left as they are
  std::size_t nonmanifold_edges = 0;        ///< with three or more triangles; left as they are
  std::size_t bow_tie_vertices = 0;         ///< where fans of triangles touch at nothing but the point; left
};

/// Cleans a shell of a file whose topology nothing vouches for, and says what it did in `diagnostics`, one
/// warning a kind, with `spot` as its place.
///
/// A component is what edges with exactly two triangles join. Where the triangles of a component do not all
/// run the same way, those of the minority are turned; a component without any border is turned outward.
/// Components that are consistent stay as they are, voids with normals into the hollow among them. Patches
/// keep their triangles' order; the points stay. Linear but for a sort of the edges at each point.
CleaningCounts clean_shell(Shell& shell, const Spot& spot, std::vector<Diagnostic>& diagnostics,
                           unsigned threads = 0);

/// What repair_shell did.
struct RepairCounts {
  std::size_t removed_points = 0;
  std::size_t added_points = 0;      ///< copies of points at which the surface was cut apart
  std::size_t turned_triangles = 0;  ///< of components that cannot be oriented without a cut
};

/// Makes a shell a manifold that a CGAL::Surface_mesh holds: removes triangles that name a point twice, cuts
/// the surface apart at edges with three or more triangles, at bow-tie vertices and, where a component cannot
/// be oriented, along a line; then removes the points that no triangle uses and renumbers the rest. No
/// triangle moves.
///
/// Call it before segmenting: Shell::creases are dropped.
RepairCounts repair_shell(Shell& shell, unsigned threads = 0);

/// repair_shell for all shells of a model, with a note on what was done.
void repair_model(Model& model, unsigned threads = 0);

/// Removes the triangles that name a point twice; corner normals and patches follow. Returns how many.
std::size_t drop_degenerate_triangles(Shell& shell);

/// Removes the triangles that name a point twice, and copies of a triangle within its patch: the same three
/// points in the same cyclic order. The first of the copies stays; mirrored ones, and copies in other
/// patches, are none. For files whose patches are known to be sound; says what it did in `diagnostics`, one
/// warning a kind, with the first patch. Linear: triangles are marked in a bit set by a hash, and only those
/// that share a mark are sorted. Returns how many were removed.
std::size_t drop_degenerate_and_duplicate_triangles(Shell& shell, std::vector<Diagnostic>& diagnostics,
                                                    unsigned threads = 0);

/// Whether a triangle has an area: twice it is more than 1e-12 of the square of its longest side. False where
/// all points lie on a line. Looks no further than the first such triangle.
bool has_area(const Shell& shell);

/// Number of points that no triangle uses.
std::size_t count_unused_points(const Shell& shell);

/// Removes the points that no triangle uses and renumbers the rest in their order. Returns how many.
std::size_t drop_unused_points(Shell& shell);

}  // namespace meshcontour
