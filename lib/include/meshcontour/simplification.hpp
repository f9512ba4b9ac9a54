#pragma once

#include <cstddef>
#include <vector>

#include "meshcontour/model.hpp"
#include "meshcontour/subdivision.hpp"

namespace meshcontour {

enum class SimplifyMethod {
  Automatic,  ///< Wavelet where the triangles come from two subdivisions or more, else Qem
  Wavelet,  ///< details of a subdivided mesh are dropped, coarsest triangles stay; others are remeshed before
  Qem,      ///< edges are collapsed by their quadric error [Garland & Heckbert 1997]
};

/// When to stop.
enum class SimplifyGoal {
  None,       ///< leave everything as it is
  Error,      ///< `value`: largest distance of the surfaces before and after, model units
  Ratio,      ///< `value`: share of the triangles that stays, in (0, 1]
  Triangles,  ///< `value`: triangles of all shells together, shared out in proportion
};

struct SimplifyOptions {
  SimplifyMethod method = SimplifyMethod::Automatic;
  SimplifyGoal goal = SimplifyGoal::None;
  double value = 0;
  BoundaryRule boundary = BoundaryRule::Reflect;  ///< of the Wavelet method
  unsigned threads = 0;                           ///< 0: one per processor
};

/// What became of one shell.
struct Simplification {
  std::size_t shell = 0;  ///< index into Model::shells
  SimplifyMethod method = SimplifyMethod::Qem;
  std::size_t triangles_before = 0, triangles_after = 0;
  unsigned levels = 0;               ///< subdivisions that the Wavelet method found or made
  std::size_t remesh_triangles = 0;  ///< of the subdivision mesh that it made; 0: none
  double remesh_error = 0;           ///< of that mesh, as `error`
  double error = 0;  ///< two-sided Hausdorff distance, patch by patch, an upper bound within 2 %; model units
};

/// Replaces a shell by a simpler one. Patches keep their numbers, and their boundary loops number, order and
/// first vertex; vertices of borders, patch borders and creases are some of those that were there, in the
/// same order. No triangle turns over, the surface keeps its topology, parts that are no manifold stay as
/// they are.
///
/// Corner normals stay where a triangle stays and are unknown elsewhere. O(n log n).
///
/// Where the Wavelet method had to remesh, borders keep their course to within the error, and their first
/// vertices.
///
/// @param triangles  to reach, for the goals Ratio and Triangles.
/// @throws Error  Usage if the goal's value is out of range; BadData if the method is Wavelet and the
///                triangles neither come from a subdivision nor are an orientable manifold, or a subdivision
///                mesh is farther from them than the error asked for.
Simplification simplify_shell(Shell& shell, const SimplifyOptions& options, std::size_t triangles);

/// simplify_shell for all shells of a model; nothing if the goal is None.
///
/// @throws Error  as above.
std::vector<Simplification> simplify_model(Model& model, const SimplifyOptions& options);

/// The Hausdorff distance of two triangle sets, measured by overlaying each with the other.
struct SurfaceDistance {
  double lower = 0;  ///< reached by a point
  double upper = 0;  ///< exceeded by none, up to rounding; at most 3 % above `lower`, or 1e-7 of the size
};

/// Distance of two shells with the same number of patches, patch to patch: the largest over the patches,
/// which is never smaller than that of the whole surfaces.
///
/// @throws Error  Internal if the numbers of patches differ or just one of two patches is empty.
SurfaceDistance patch_distance(const Shell& a, const Shell& b, unsigned threads = 0);

}  // namespace meshcontour
