#pragma once

#include <cstddef>
#include <numbers>
#include <vector>

#include "meshcontour/model.hpp"

namespace meshcontour {

/// Where the patches of a model come from.
enum class PatchSource {
  Automatic,   ///< the file's own; by angle for a file that has none
  File,        ///< the file's own; the whole shell is one patch where it has none
  Angle,       ///< cut along sharp edges
  Components,  ///< one patch a connected component
  None,        ///< the whole shell is one patch
};

struct SegmentOptions {
  PatchSource source = PatchSource::Automatic;
  double feature_angle = 30 * std::numbers::pi / 180;  ///< an edge is sharp from it on, radians in (0, pi)
  unsigned threads = 0;                                ///< 0: one per processor
};

/// Gives every shell its patches as the options say. Triangles are reordered so that a patch is a range.
///
/// Model::has_patches is set; sharp edges inside patches go to Shell::creases and are counted in a note.
///
/// @throws Error  Usage if the angle is out of range.
void segment_model(Model& model, const SegmentOptions& options = {});

/// Cuts a shell into patches along its sharp edges; linear.
///
/// Two triangles are in one patch when a chain of smooth edges joins them. An edge is smooth when exactly two
/// triangles share it and
/// their planes meet at less than the angle, by 1e-4 at least, whichever way the triangles run.
/// Triangles too thin to have a direction of their own (lower than the coordinates' rounding) take their
/// neighbour's across the longest side. Patches are numbered by their first triangle, and triangles keep
/// their order within a patch; corner normals follow their triangles. Shell::creases receives the sharp edges
/// with one patch on both sides, sorted.
///
/// @param radians  in (0, pi).
/// @return         the number of patches.
std::size_t segment_by_feature_angle(Shell& shell, double radians, unsigned threads = 0);

/// One patch a component of triangles that are joined by edges, of any number of triangles. Numbered and
/// ordered as above; linear.
std::size_t segment_by_components(Shell& shell, unsigned threads = 0);

/// One patch for the whole shell; triangles and corner normals stay as they are.
void merge_patches(Shell& shell);

/// Makes patches from one number a triangle: triangles with the same number form a patch, patches are ordered
/// by their first triangle, and triangles keep their order within a patch. Linear in the triangles plus the
/// largest number.
///
/// @param numbers  one a triangle.
/// @return         for every patch the number it came from.
std::vector<Index> group_triangles(Shell& shell, const std::vector<Index>& numbers);

}  // namespace meshcontour
