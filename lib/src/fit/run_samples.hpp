#pragma once

// The points that a run is fitted by: its own, fewer where they are dense, more where they are sparse.

#include <cstddef>
#include <span>
#include <vector>

#include "fit/knots.hpp"
#include "fit/least_squares.hpp"

namespace meshcontour::detail {

/// A run in units that make it about 1 large, its first point at the origin.
struct NormalizedRun {
  std::vector<Point> points;  ///< consecutive ones distinct
  std::vector<double>
      parameters;  ///< arc length, estimated; 0 at the first point. Closed: one more, the first's again
  std::vector<double> limits;  ///< the largest distance of curve and chord, one a chord
  double tolerance = 0;        ///< the largest distance of curve and point
  bool closed = false;
  EndTangents tangents;
};

/// Points in the order of the run, and what a curve has to keep at them.
struct RunSamples {
  std::vector<Point> points;
  std::vector<double> parameters;  ///< one a point
  double end = 0;                  ///< parameter of the last point, of a closed run that of the first again
  std::size_t stride = 1;      ///< points 0, stride, 2 stride ... are vertices; those between lie on a smooth
                               ///< curve through the vertices, and only hint
  std::vector<double> limits;  ///< one a chord of the vertices; empty: none
  double tolerance = 0;        ///< at the vertices
  bool closed = false;
  EndTangents tangents;
};

/// Samples and where they want knots.
struct SampledRun {
  RunSamples samples;
  KnotDensity density;
  bool thinned = false;  ///< only some of the run's points: an accepted curve is still to be tried on all
};

/// Every point.
RunSamples all_samples(const NormalizedRun& run);

/// As few points as tell where the knots go, at least half a dozen a span. Too few of them for that: all, and
/// up to three more on each chord, from the cubic interpolation. O(points).
SampledRun sample_run(const NormalizedRun& run);

/// Parameters of all points, from what became of those of some of them: linear in between.
///
/// @param thinned  samples of the run; `moved` are their parameters after a fit.
std::vector<double> spread_parameters(const NormalizedRun& run, const RunSamples& thinned,
                                      std::span<const double> moved);

}  // namespace meshcontour::detail
