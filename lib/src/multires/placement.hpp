#pragma once

#include <utility>
#include <vector>

#include "multires/curve_split.hpp"
#include "multires/level.hpp"
#include "multires/self_parameterization.hpp"

namespace meshcontour::detail {

/// Finds the places of a subdivided base mesh on the surface that it was made of.
class Placement {
 public:
  /// @param shell    the surface.
  /// @param surface  made of it, with the base mesh.
  /// @param base     the base mesh, its triangles in the order in which `surface` has them.
  /// @param levels   of the subdivision.
  Placement(const Shell& shell, const SelfParameterization& surface, const MeshLevel& base, unsigned levels);

  /// The places of the vertices of the subdivided base mesh. Those on sharp edges are vertices of the
  /// surface, as long as there are some, and places between are moved accordingly.
  std::vector<SurfacePlace> vertices(const MeshLevel& finest, unsigned threads) const;

  /// The place of the middle of a triangle of the subdivided base mesh.
  SurfacePlace middle(Index triangle) const;

 private:
  using Weights = std::array<double, 3>;

  struct Curve {
    std::vector<Index> vertices;  // in the beginning; none where an edge is not sharp
    CurveSplit split;
  };
  struct Side {
    const Curve* curve = nullptr;  // or nullptr where it is not sharp
    bool forward = true;           // whether it runs as its curve does
  };
  using SharpEdge = std::pair<std::array<Index, 2>, Index>;  // its ends, and a halfedge

  void find_curves();
  Side side(Index triangle, std::size_t k) const;
  std::array<Weights, 3> corners(Index triangle) const;
  SurfacePlace on_surface(const SurfacePlace& place) const;
  SurfacePlace at_vertex(Index v) const;
  SurfacePlace on_curve(const Side& side, double share) const;
  SurfacePlace inside(const SurfacePlace& place) const;

  const Shell& shell_;
  const SelfParameterization& surface_;
  const MeshLevel& base_;
  unsigned levels_;
  std::vector<Index> slots_;            // of each base triangle: its number on the surface
  std::vector<Curve> curves_;           // of each base edge
  std::vector<SharpEdge> sharp_edges_;  // of the surface, sorted
  std::vector<Index> corner_of_;        // of each point of the shell: a corner of a triangle there
};

}  // namespace meshcontour::detail
