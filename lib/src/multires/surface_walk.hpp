#pragma once

#include <vector>

#include "meshcontour/remeshing.hpp"
#include "multires/level.hpp"

namespace meshcontour::detail {

/// Straight ways across the triangles of a surface.
class SurfaceWalk {
 public:
  /// @param level  of the shell; ways end at its sharp edges.
  SurfaceWalk(const Shell& shell, const MeshLevel& level);

  /// Where one comes to from a place by going straight along the surface, in the direction and as far as the
  /// part of `way` says that lies in it.
  SurfacePlace from(SurfacePlace place, Vector way) const;

  Point point(const SurfacePlace& place) const;

  /// Of length 1, or 0 where a triangle has no area.
  const Vector& normal(Index triangle) const { return normals_[triangle]; }

 private:
  std::size_t cross(SurfacePlace& place, Vector& way) const;

  const Shell& shell_;
  const MeshLevel& level_;
  std::vector<Vector> normals_;
};

}  // namespace meshcontour::detail
