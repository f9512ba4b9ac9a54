#pragma once

// How far a curve may leave the chords of its points, and whether one does.

#include <span>
#include <vector>

#include "meshcontour/curve.hpp"

namespace meshcontour::detail {

/// For each chord, the distance to it that a calm curve keeps: tolerance + 1.75 s, where s = L/2 tan(a/4) is
/// the sagitta of an arc over a chord of length L that turns by a, the larger turning at its two ends. The
/// ends of an open run do not count: they may be corners.
///
/// @param points  at least 2; the result has one entry a chord, the last one of a closed loop back to
/// points[0].
std::vector<double> calm_limits(std::span<const Point> points, bool closed, double tolerance);

}  // namespace meshcontour::detail
