#include "fit/spline_run.hpp"

#include <algorithm>
#include <cmath>

#include "fit/certificate.hpp"
#include "fit/cleaning.hpp"
#include "fit/parametrize.hpp"
#include "fit/span_search.hpp"
#include "fit/whole_loop.hpp"

namespace meshcontour::detail {
namespace {

// A power of two, so that scaling loses no bit.
double unit_of(std::span<const Point> points) {
  const double diagonal = box_diagonal(points);
  return diagonal > 0 ? std::exp2(std::floor(std::log2(diagonal))) : 1;
}

NormalizedRun make_run(std::span<const Point> points, const SplineRunOptions& options, double unit) {
  NormalizedRun run;
  run.points.reserve(points.size());
  for (const Point& p : points) run.points.push_back((p - points.front()) / unit);
  run.tolerance = options.tolerance / unit;
  run.closed = options.closed;
  run.tangents = {options.start_tangent, options.end_tangent};
  ChordGeometry geometry = chord_geometry(run.points, run.closed);
  run.parameters = std::move(geometry.parameters);
  run.limits = calm_limits(geometry.sagittas, run.tolerance);
  return run;
}

void take(SplineRun& result, const SpanSearch& search, const RunSamples& samples) {
  result.curve = search.curve();
  result.parameters.clear();
  for (std::size_t i = 0; i < samples.points.size(); i += samples.stride) {
    result.parameters.push_back(search.parameters()[i]);
  }
  result.vertex_error = search.vertex_error();
  result.accepted = true;
}

// Fewer samples find the knots, all points the curve.
bool fit_thinned(const NormalizedRun& run, const SampledRun& sampled, SplineRun& result) {
  SplineFit few(sampled.samples);
  SpanSearch among_few(few, sampled.samples, sampled.density);
  const bool found = among_few.search();
  RunSamples samples = all_samples(run);
  if (found) samples.parameters = spread_parameters(run, sampled.samples, among_few.parameters());
  SplineFit fit(samples);
  SpanSearch search(fit, samples, among_few.density());
  if (!(found && search.accept(among_few.breaks())) && !search.search()) return false;
  take(result, search, samples);
  return true;
}

bool fit_least_squares(const NormalizedRun& run, SplineRun& result) {
  const SampledRun sampled = sample_run(run);
  if (sampled.thinned) return fit_thinned(run, sampled, result);
  SplineFit fit(sampled.samples);
  SpanSearch search(fit, sampled.samples, sampled.density);
  if (!search.search()) return false;
  take(result, search, sampled.samples);
  return true;
}

// The curve through all points, which is all that is left to try.
void interpolate(const NormalizedRun& run, SplineRun& result) {
  ParametrizedCurve through = interpolation(run.points, run.parameters, run.closed);
  result.curve = std::move(through.curve);
  result.parameters = std::move(through.parameters);
  const std::size_t n = run.points.size();
  double worst = 1;
  for (std::size_t i = 0; i < run.limits.size(); ++i) {
    const double excess = chord_deviation(result.curve, run.parameters[i], run.parameters[i + 1],
                                          run.points[i], run.points[(i + 1) % n], run.limits[i]) /
                          run.limits[i];
    if (excess <= worst || !(worst >= 1)) continue;  // no number stays the worst
    result.worst_chord = i;
    worst = excess;
  }
  result.accepted = worst <= 1;
}

void scale_back(SplineRun& result, std::span<const Point> points, double unit) {
  for (Point& p : result.curve.control_points) p = points.front() + unit * p;
  if (!result.curve.periodic) result.curve.control_points.back() = points.back();
  for (double& t : result.curve.knots) t *= unit;
  for (double& t : result.parameters) t *= unit;
  result.vertex_error *= unit;
  result.deviation *= unit;
}

}  // namespace

SplineRun fit_spline_run(std::span<const Point> points, const SplineRunOptions& options) {
  const double unit = unit_of(points);
  const NormalizedRun run = make_run(points, options, unit);
  SplineRun result;
  const bool enough = points.size() > 3;
  if (!enough || !fit_least_squares(run, result)) interpolate(run, result);
  result.deviation = spline_deviation(result.curve, run.points, result.parameters, run.closed);
  scale_back(result, points, unit);
  return result;
}

}  // namespace meshcontour::detail
