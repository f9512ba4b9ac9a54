#pragma once

#include <vector>

#include "meshcontour/model.hpp"

namespace meshcontour::detail {

/// A point of a surface that a mesh is to follow.
struct SurfaceSample {
  Point point = Point::Zero();
  Vector normal = Vector::Zero();  ///< of length 1, or zero where the surface has no area
  double share = 0;                ///< of the surface, not negative
  Index triangle = 0;              ///< of the mesh, where it lies on it
};

/// Samples of a surface: its vertices, in every patch that has them, and points inside its triangles where
/// the mesh has so many triangles that vertices alone would be few for each. They lie on the nearest triangle
/// of the same patch; those that it turns its back to are left out.
///
/// @param mesh  with the patches of the surface.
std::vector<SurfaceSample> surface_samples(const Shell& surface, const Shell& mesh, unsigned threads);

}  // namespace meshcontour::detail
