#pragma once

// One smooth run of a loop, or a whole smooth loop, as one cubic B-spline within a tolerance.

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "meshcontour/curve.hpp"

namespace meshcontour::detail {

struct SplineRunOptions {
  double tolerance = 0;  ///< largest distance of a point to the curve, model units, positive
  bool closed = false;   ///< the run is a whole loop: the curve is periodic
  std::optional<Vector> start_tangent = {};  ///< of length 1, in the direction of travel; open runs only
  std::optional<Vector> end_tangent = {};    ///< of length 1, in the direction of travel; open runs only
};

struct SplineRun {
  BSplineCurve curve;  ///< cubic; periodic or clamped, then its ends are the points' to the last bit
  std::vector<double> parameters;  ///< one a point, increasing: where the curve is nearest to it
  double vertex_error = 0;         ///< largest distance of a point to the curve at its parameter, model units
  double deviation = 0;         ///< proven bound of the Hausdorff distance of curve and chords, model units
  bool accepted = false;        ///< every point within the tolerance, and the curve calm between them
  std::size_t worst_chord = 0;  ///< the chord, by its first point, that is farthest beyond what calm allows
};

/// Fits a cubic B-spline with few control points, by least squares with knots where the fourth derivative is
/// large.
///
/// A run of two points is a line, one of three a parabola, both as cubics. The fit is `accepted` if every
/// point lies within the tolerance, and the curve stays within tolerance + 1.75 s of each chord, s being the
/// sagitta that the turning at its two ends implies: a curve through few points may meet them all and swing
/// out between them. If no knots achieve that, the result is the calmest interpolation found, not accepted.
/// O(n log n).
///
/// @param points  at least 2, at least 3 if closed; consecutive points distinct, as from clean_points.
SplineRun fit_spline_run(std::span<const Point> points, const SplineRunOptions& options);

}  // namespace meshcontour::detail
