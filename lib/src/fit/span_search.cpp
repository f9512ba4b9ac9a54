#include "fit/span_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meshcontour::detail {
namespace {

constexpr int kRounds = 2;              // of least squares and footpoints a fit
constexpr int kBalancings = 4;          // of the knots at one number of spans
constexpr double kHopeless = 3.0;       // times what is allowed: moving knots does not mend that
constexpr std::size_t kFineSpans = 64;  // up to here the smallest number is found exactly, then to this share
constexpr double kSmallestFactor = 0.6, kLargestFactor = 2.5;

std::size_t clamped(double wanted, std::size_t low, std::size_t high) {
  if (!(wanted < static_cast<double>(high))) return high;
  return wanted > static_cast<double>(low) ? static_cast<std::size_t>(std::lround(wanted)) : low;
}

}  // namespace

SpanSearch::SpanSearch(SplineFit& fit, const RunSamples& samples, KnotDensity density)
    : fit_(fit),
      samples_(samples),
      first_(density),
      start_(std::move(density)),
      start_parameters_(fit.parameters()),
      start_error_(std::numeric_limits<double>::infinity()) {
  const std::size_t vertices = (samples.points.size() + samples.stride - 1) / samples.stride;
  lowest_ = samples.closed ? 4 : 1;
  highest_ = samples.closed ? vertices : vertices - std::min<std::size_t>(vertices, 3);
}

bool SpanSearch::search() {
  if (highest_ < lowest_) return false;
  std::size_t rejected = lowest_ - 1, accepted = highest_ + 1;
  std::size_t spans = clamped(start_.total(), lowest_, highest_);
  while (accepted - rejected > 1 + accepted / kFineSpans) {
    const bool good = attempt(spans);
    if (good) {
      accepted = spans;
      keep();
    } else {
      rejected = spans;
    }
    if (accepted - rejected <= 1) break;
    const std::size_t low = rejected + 1, high = accepted - 1;
    spans = clamped(start_.total(), low, high);
    if (!good && accepted > highest_) spans = std::max(spans, std::min(high, low + rejected / 8));
  }
  return accepted <= highest_;
}

bool SpanSearch::accept(std::span<const double> breaks) {
  breaks_.assign(breaks.begin(), breaks.end());
  if (!fit_.fit(breaks_, kRounds) || !fit_.accepted()) return false;
  keep();
  return true;
}

bool SpanSearch::attempt(std::size_t spans) {
  const bool balanced = std::isfinite(start_error_);
  return try_density(KnotDensity(start_), spans) || (balanced && try_density(first_, spans));
}

// Fits with this number of spans, moving the knots to where the errors are.
bool SpanSearch::try_density(const KnotDensity& density, std::size_t spans) {
  KnotDensity current = density;
  fit_.set_parameters(start_parameters_);
  double smallest = std::numeric_limits<double>::infinity(), power = 0.25;
  for (int round = 0; round <= kBalancings; ++round) {
    current.distribute(spans, breaks_);
    if (!fit_.fit(breaks_, kRounds)) return false;
    const bool good = fit_.accepted();
    const double worst = fit_.worst_error();
    if (worst > smallest) power /= 2;  // the step before was too long
    smallest = std::min(smallest, worst);
    balance(current, power);
    if (worst < start_error_) {
      start_error_ = worst;
      start_parameters_ = fit_.parameters();
      start_ = current;
    }
    if (good) return true;
    if (worst > kHopeless) return false;
  }
  return false;
}

// On a span of length h a cubic errs by h^4, so that a span with n^4 times the error wants to be n spans.
void SpanSearch::balance(KnotDensity& density, double power) {
  const std::vector<double>& errors = fit_.span_errors();
  const std::size_t spans = errors.size();
  wanted_.resize(spans);
  for (std::size_t k = 0; k < spans; ++k) {
    const double before = errors[k > 0 ? k - 1 : samples_.closed ? spans - 1 : 0];
    const double after = errors[k + 1 < spans ? k + 1 : samples_.closed ? 0 : spans - 1];
    const double error = std::max(errors[k], std::max(before, after) / 8);
    wanted_[k] = std::clamp(std::pow(error, power), kSmallestFactor, kLargestFactor);
  }
  density.rescale(breaks_, wanted_);
}

void SpanSearch::keep() {
  best_.curve = fit_.curve();
  best_.parameters = fit_.parameters();
  best_.breaks = breaks_;
  best_.vertex_error = fit_.vertex_error();
}

}  // namespace meshcontour::detail
