#pragma once

#include "render/scene.hpp"

namespace meshcontour::detail {

/// Leaves out placements that leave no trace or cannot be told apart, in frames that have very many. Faces:
/// those that no sample lies in. Lines and points of placements smaller than an eighth of a pixel: these
/// become dots, as wide as the lines, of which the nearest of each eighth of a pixel is drawn. Does nothing
/// in perspective.
///
/// O(n log n) in the placements.
///
/// @param extents  a frame's points lie within +- these in its coordinates; zero where nothing is known.
void leave_out_tiny(Scene& scene, const std::vector<Eigen::Vector3d>& extents);

}  // namespace meshcontour::detail
