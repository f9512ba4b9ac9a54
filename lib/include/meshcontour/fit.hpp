#pragma once

#include <numbers>
#include <span>
#include <vector>

#include "meshcontour/boundary.hpp"
#include "meshcontour/curve.hpp"

namespace meshcontour {

/// How a loop becomes a curve.
enum class FitMethod {
  Control,      ///< the vertices are the control points of a closed uniform cubic B-spline, as in the report
  Interpolate,  ///< the periodic cubic through the vertices
  Approximate,  ///< corners kept, B-splines within the tolerance between them
  Primitives,  ///< corners, lines, circular and elliptical arcs, B-splines for the rest, within the tolerance
};

struct FitOptions {
  FitMethod method = FitMethod::Primitives;
  double tolerance =
      0;  ///< largest distance of curve and loop vertices, model units; 0: 1e-4 of the loop's box diagonal
  double corner_angle = 35 * std::numbers::pi / 180;  ///< a loop turns by more than this at a corner, radians
  unsigned threads = 0;                               ///< 0: one per processor
};

/// The contours of all loops, in order of shell, patch and loop. Open chains give open contours.
///
/// A loop that cannot be fitted gets its polygon as line segments, `fallback` set and a diagnostic.
///
/// @param boundaries  as from extract_boundaries for the same model.
/// @throws Error      Usage if an option is out of range.
std::vector<Contour> fit_contours(const Model& model, std::span<const ShellBoundary> boundaries,
                                  const FitOptions& options, std::vector<Diagnostic>& diagnostics);

/// For each contour and each of its segments, whether earlier segments of the shell already run along all of
/// its edges: what is left out when every edge is to be written once. Segments without edges are never
/// repeats.
///
/// @param contours  those that are written, in their order; any subset of a model's.
std::vector<std::vector<bool>> repeated_segments(std::span<const Contour> contours);

/// The closed uniform cubic B-spline whose control points are the points of a loop, the first three repeated;
/// knots 0, 1, 2, ... The curve lies inside the loop: on a circle by 4/3 of the chords' sagitta.
///
/// @param points  N >= 3.
BSplineCurve control_polygon_curve(std::span<const Point> points);

/// The periodic cubic B-spline through the points of a loop, with chord-length knots; O(N).
///
/// @param points  N >= 3, consecutive points (last and first too) distinct.
BSplineCurve interpolate_closed(std::span<const Point> points);

}  // namespace meshcontour
