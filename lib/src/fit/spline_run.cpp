#include "fit/spline_run.hpp"

#include <algorithm>

#include "fit/calm.hpp"
#include "fit/certificate.hpp"
#include "fit/whole_loop.hpp"

namespace meshcontour::detail {
namespace {

// Vertex error, certificate and verdict of a curve.
void judge(SplineRun& run, std::span<const Point> points, const SplineRunOptions& options) {
  const std::size_t n = points.size();
  const std::vector<double> limits = calm_limits(points, options.closed, options.tolerance);
  const double period = run.curve.domain().second - run.curve.domain().first;
  double worst = -1;
  bool calm = true;
  for (std::size_t i = 0; i < limits.size(); ++i) {
    const double end = i + 1 < n ? run.parameters[i + 1] : run.parameters[0] + period;
    const double bound =
        chord_deviation(run.curve, run.parameters[i], end, points[i], points[(i + 1) % n], limits[i]);
    if (bound > limits[i]) calm = false;
    if (bound / limits[i] > worst) {
      worst = bound / limits[i];
      run.worst_chord = i;
    }
  }
  run.deviation = spline_deviation(run.curve, points, run.parameters, options.closed);
  run.accepted = calm && run.vertex_error <= options.tolerance;
}

}  // namespace

SplineRun fit_spline_run(std::span<const Point> points, const SplineRunOptions& options) {
  ParametrizedCurve fitted = options.closed       ? closed_interpolation(points)
                             : points.size() == 3 ? open_control_curve(points)
                                                  : open_interpolation(points);
  if (!options.closed && points.size() == 3) {  // the parabola through the middle point
    const Point middle = 2 * points[1] - (points[0] + points[2]) / 2;
    fitted.curve.control_points[1] = (points[0] + 2 * middle) / 3;
    fitted.curve.control_points[2] = (2 * middle + points[2]) / 3;
  }
  SplineRun run;
  run.curve = std::move(fitted.curve);
  run.parameters = std::move(fitted.parameters);
  judge(run, points, options);
  return run;
}

}  // namespace meshcontour::detail
