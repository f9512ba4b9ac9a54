#pragma once

#include "boundary/workspace.hpp"
#include "meshcontour/model.hpp"

namespace meshcontour::detail {

/// What a halfedge mesh can hold of some triangles: on each edge at most two, which run opposite ways, and at
/// each vertex one fan.
struct HeldTriangles {
  std::vector<Triangle> triangles;    ///< over `vertices`; those of other fans at a vertex have a copy of it
  std::vector<Index> vertices;        ///< vertices of the shell
  std::vector<std::size_t> sources;   ///< the triangle of the shell that each one is
  std::vector<bool> flipped;          ///< whether it runs against its source
  std::vector<Index> opposite;        ///< one a side 3 t + k, as in Adjacency; kNoSide on the border
  std::size_t rejected_as_given = 0;  ///< triangles that did not fit as they run
  std::vector<std::size_t> unheld;    ///< triangles of the shell that fit in neither orientation
};

/// Takes the triangles first .. first + count - 1 of a shell in their order, each where its edges are still
/// free. If one does not fit, starts anew with all of them oriented alike, and tries those that do not fit
/// the other way round. Linear.
HeldTriangles hold_triangles(const Shell& shell, std::size_t first, std::size_t count,
                             ZeroedArray<Index>& slots);

}  // namespace meshcontour::detail
