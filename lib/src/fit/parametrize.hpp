#pragma once

// First parameters of a run's points, and how calm a curve through them has to be.

#include <span>
#include <vector>

#include "meshcontour/types.hpp"

namespace meshcontour::detail {

/// What the chords of a run tell of the curve that they approximate.
struct ChordGeometry {
  std::vector<double>
      parameters;  ///< arc length of that curve, estimated; 0 at the first point. Closed: one more
  std::vector<double> sagittas;  ///< of each chord
};

/// Each chord is taken for that of an arc which turns by the mean of the turnings at its two ends, at most 40
/// degrees: L (a/2) / sin(a/2) long; its sagitta is L/2 tan(b/4), b being the larger turning. The ends of an
/// open run have none: they may be corners.
///
/// @param points  at least 2, consecutive ones distinct.
ChordGeometry chord_geometry(std::span<const Point> points, bool closed);

/// For each chord, the distance to it that a calm curve keeps: tolerance + 1.75 sagittas.
std::vector<double> calm_limits(std::span<const double> sagittas, double tolerance);

}  // namespace meshcontour::detail
