#pragma once

#include "multires/level.hpp"
#include "multires/surface_walk.hpp"

namespace meshcontour::detail {

/// Moves the vertices of a mesh that lies on a surface along it.
class Relaxation {
 public:
  /// @param fine    triangles and patches of the mesh, one for each of the surface's patches.
  /// @param finest  the same mesh's connectivity; vertices at sharp edges stay where they are.
  /// @param places  of its vertices on the surface.
  Relaxation(const Shell& fine, const MeshLevel& finest, const Shell& shell, const SurfaceWalk& walk,
             std::vector<SurfacePlace> places);

  /// Moves every vertex but the first ones to the middle of its neighbours where this makes the triangles
  /// around it no worse, one after the other; not those on triangles of the surface that stay as they are.
  void smooth(Index first, const std::vector<bool>& kept);

  /// The same for vertices of triangles that are turned over, and those next to them; returns how many
  /// triangles were.
  std::size_t unfold();

  /// Triangles that are turned over, beside the surface at their corners.
  std::vector<Index> flipped() const;

  const std::vector<SurfacePlace>& places() const { return places_; }

 private:
  double shape(Index triangle) const;
  double lack_around(double least) const;
  void around(Index v);
  bool move(Index v, double part, double least);

  const MeshLevel& finest_;
  const SurfaceWalk& walk_;
  std::vector<SurfacePlace> places_;
  std::vector<Point> points_;
  std::vector<std::size_t> patches_, fine_patches_;  // of each triangle
  std::vector<Index> ring_;                          // halfedges that leave a vertex
};

}  // namespace meshcontour::detail
