#include "fit/run_samples.hpp"

#include <algorithm>
#include <cmath>

#include "fit/whole_loop.hpp"

namespace meshcontour::detail {
namespace {

constexpr std::size_t kFewestSamples = 128;
constexpr double kSamplesPerSpan = 6;   // of a thinned run
constexpr double kPointsPerSpan = 2.5;  // with fewer, samples are added
constexpr double kFurtherSpans = 2;     // than the density says
constexpr std::size_t kLargestStride = 4;
constexpr double kThinnedTolerance = 0.97;  // of the tolerance: the largest error may lie between the samples

RunSamples like(const NormalizedRun& run) {
  RunSamples samples;
  samples.end = run.parameters.back();
  samples.tolerance = run.tolerance;
  samples.closed = run.closed;
  samples.tangents = run.tangents;
  return samples;
}

// Which of n points is the k-th of `count`; an open run's last is its last.
std::size_t thinned_index(std::size_t k, std::size_t count, std::size_t n, bool closed) {
  return closed ? k * n / count : k * (n - 1) / (count - 1);
}

RunSamples thinned_samples(const NormalizedRun& run, std::size_t count) {
  RunSamples samples = like(run);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = thinned_index(k, count, run.points.size(), run.closed);
    samples.points.push_back(run.points[i]);
    samples.parameters.push_back(run.parameters[i]);
  }
  return samples;
}

RunSamples refined_samples(const NormalizedRun& run, std::size_t stride) {
  RunSamples samples = like(run);
  samples.stride = stride;
  samples.limits = run.limits;
  const BSplineCurve smooth = interpolation(run.points, run.parameters, run.closed).curve;
  for (std::size_t i = 0; i + 1 < run.parameters.size(); ++i) {
    const double begin = run.parameters[i], step = run.parameters[i + 1] - begin;
    for (std::size_t k = 0; k < stride; ++k) {
      samples.parameters.push_back(begin + step * static_cast<double>(k) / static_cast<double>(stride));
      samples.points.push_back(k == 0 ? run.points[i] : evaluate(smooth, samples.parameters.back()));
    }
  }
  if (!run.closed) {
    samples.parameters.push_back(run.parameters.back());
    samples.points.push_back(run.points.back());
  }
  return samples;
}

KnotDensity density_of(const NormalizedRun& run, const RunSamples& samples) {
  std::vector<double> parameters = samples.parameters;
  if (run.closed) parameters.push_back(samples.end);
  return {samples.points, parameters, run.closed, run.tolerance};
}

}  // namespace

RunSamples all_samples(const NormalizedRun& run) {
  RunSamples samples = like(run);
  samples.points = run.points;
  samples.parameters.assign(run.parameters.begin(),
                            run.parameters.begin() + static_cast<std::ptrdiff_t>(run.points.size()));
  samples.limits = run.limits;
  return samples;
}

SampledRun sample_run(const NormalizedRun& run) {
  const std::size_t n = run.points.size();
  for (std::size_t count = kFewestSamples; count < n / 2; count *= 2) {
    RunSamples samples = thinned_samples(run, count);
    KnotDensity density = density_of(run, samples);
    if (kSamplesPerSpan * (density.total() + kFurtherSpans) <= static_cast<double>(count)) {
      samples.tolerance *= kThinnedTolerance;
      return {std::move(samples), std::move(density), true};
    }
  }
  RunSamples samples = all_samples(run);
  KnotDensity density = density_of(run, samples);
  const double wanted = kPointsPerSpan * (density.total() + kFurtherSpans) / static_cast<double>(n);
  if (n > 4 && wanted > 1) {
    samples = refined_samples(
        run, wanted < kLargestStride ? static_cast<std::size_t>(std::ceil(wanted)) : kLargestStride);
  }
  return {std::move(samples), std::move(density), false};
}

std::vector<double> spread_parameters(const NormalizedRun& run, const RunSamples& thinned,
                                      std::span<const double> moved) {
  const std::size_t n = run.points.size(), count = thinned.points.size();
  std::vector<double> parameters(n);
  for (std::size_t k = 0; k < count; ++k) {
    const bool last = k + 1 == count;
    if (last && !run.closed) break;
    const std::size_t first = thinned_index(k, count, n, run.closed);
    const std::size_t next = last ? n : thinned_index(k + 1, count, n, run.closed);
    const double begin = run.parameters[first], step = run.parameters[next] - begin;
    const double moved_step = (last ? moved[0] + thinned.end : moved[k + 1]) - moved[k];
    for (std::size_t i = first; i < next; ++i) {
      parameters[i] = moved[k] + (run.parameters[i] - begin) / step * moved_step;
    }
  }
  if (!run.closed) parameters.back() = run.parameters.back();
  return parameters;
}

}  // namespace meshcontour::detail
