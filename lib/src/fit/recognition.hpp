#pragma once

#include <map>
#include <tuple>
#include <vector>

#include "fit/model_evidence.hpp"
#include "fit/path.hpp"
#include "fit/piece.hpp"
#include "fit/spline_run.hpp"

namespace meshcontour::detail {

/// How one chain is taken apart.
struct RecognitionOptions {
  double tolerance = 0;     ///< largest distance of a vertex to its curve, model units, positive
  double corner_angle = 0;  ///< a path turns by more than this at a hard corner, radians
  double noise = 0;         ///< what the points may be off by themselves, model units
  double coarsest = 0;      ///< largest sagitta that a chord of a curve may have, model units
  bool primitives = true;   ///< false: lines and B-splines only
  bool bounded = false;     ///< the ends are patch corners, so that the chain is most likely one edge
  const ModelEvidence* evidence = nullptr;  ///< what is known of the whole model, from a first pass
  std::size_t shell = 0;                    ///< whose arcs count as support
};

/// A chain as curves that join end to end.
struct Recognition {
  Path path;                  ///< of a closed chain, maybe started at another point
  std::vector<Piece> pieces;  ///< from point 0 to the last one
};

/// The B-splines of one chain, each fitted once.
class SplineCache {
 public:
  explicit SplineCache(double tolerance) : tolerance_(tolerance) {}

  /// The curve of points begin .. end of the path, or of one that was rotated; of a whole ring a periodic
  /// one.
  const SplineRun& run(const Path& path, std::size_t begin, std::size_t end, bool ring);

 private:
  double tolerance_;
  std::map<std::tuple<std::size_t, std::size_t, bool>, SplineRun> runs_;  // by the ends in the chain
};

/// Length of a description: 4 a line, 7 an arc, 8 a circle, 10 an ellipse; a spline 1, 3 a control point
/// and 1 an inner knot.
double description_cost(const std::vector<Piece>& pieces);

/// Takes a chain apart into lines, arcs, ellipses and B-splines.
///
/// Points are matched at a ladder of tolerances from the noise up to `tolerance`; the tightest one is taken
/// whose description is hardly longer than the shortest. So clean data is recognized at its own precision,
/// and noisy data at its noise.
Recognition recognize(Path path, const RecognitionOptions& options);

/// Whether recognize could give something else now that `options.evidence` is known. Linear.
bool may_change(const Recognition& fit, const RecognitionOptions& options);

}  // namespace meshcontour::detail
