#include "fit/span_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meshcontour::detail {
namespace {

constexpr int kSearchRounds = 1, kLastRounds = 2;  // of least squares and footpoints a fit
constexpr int kBalancings = 4,
              kMostBalancings = 8;  // of the knots at one number of spans; the most if nearly there

// All errors are multiples of what is allowed. These stop what is not going to succeed.
constexpr double kHopeless = 3;             // moving knots does not mend such an error
constexpr double kHopelessBalanced = 1.25;  // even if all spans shared the error evenly
constexpr double kNearly = 1.05;            // below this, knots are moved on even if that makes it worse
constexpr double kProgress = 0.965;         // the least that moving knots has to achieve at once
constexpr double kFewerUntouched = 1.3;     // expected with one span less, had the knots not been moved yet
constexpr double kFewerBalanced = 1.08;     // or had they been
constexpr double kFewerAtLast = 2;          // or for the last attempts, which get more rounds
constexpr double kFewerOfFew = 1.1;         // or where quickness is worth more than a control point
constexpr std::size_t kQuickVertices = 40;  // which it is up to here: so short loops come in thousands
constexpr std::size_t kFewVertices = 32;    // so few that nothing is stopped early

constexpr double kSuspicious = 1.4;          // times the spans that the points ask for
constexpr std::size_t kFewToRepeat = 1'000;  // spans at most, for a search to be repeated thoroughly

constexpr double kFirstShare = 0.95;  // of the spans that the density says; all of them if quickness counts
constexpr double kNextShare = 0.7;    // of the spans that a rejected fit seems to need
constexpr double kNextShareBalanced = 1;  // the same once its knots have been moved, if quickness counts
constexpr std::size_t kFineSpans = 64;  // up to here the smallest number is found exactly, then to this share
constexpr std::size_t kFewestReduced = 256;  // spans of which more than one may be taken away at last
constexpr double kPower = 0.12;  // half of the 1/4 that equal errors ask for: steps do not overshoot
constexpr double kSmallestFactor = 0.6, kLargestFactor = 2.5;

double fourth_power(double x) {
  return x * x * x * x;
}

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
  thorough_ = samples.stride > 1 && vertices < kFewVertices;
  quick_ = !thorough_ && vertices < kQuickVertices;
  lowest_ = samples.closed ? 4 : 1;
  highest_ = samples.closed ? vertices : vertices - std::min<std::size_t>(vertices, 3);
}

// Stopping early loses now and then; a result with so many spans more than the points ask for shows it.
bool SpanSearch::search() {
  rounds_ = thorough_ ? kLastRounds : kSearchRounds;
  std::size_t found = search_below(highest_ + 1);
  rounds_ = kLastRounds;
  if (found <= highest_) found = reduced(found);
  const double suspicious = kSuspicious * (first_.total() + 1);
  if (!thorough_ && highest_ <= kFewToRepeat && static_cast<double>(found) > suspicious) {
    thorough_ = true;
    start_ = first_;
    start_error_ = std::numeric_limits<double>::infinity();
    found = search_below(found);
  }
  return found <= highest_;
}

// One span less at a time than the accepted number, of many a small share, as long as that goes well.
std::size_t SpanSearch::reduced(std::size_t accepted) {
  const double worth = quick_ ? kFewerOfFew : kFewerAtLast;
  while (accepted > lowest_) {
    const std::size_t fewer = accepted - 1 - accepted / kFewestReduced;
    const double ratio = static_cast<double>(accepted) / static_cast<double>(fewer);
    if (fewer < lowest_ || start_error_ * fourth_power(ratio) > worth || !attempt(fewer)) break;
    keep();
    accepted = fewer;
  }
  return accepted;
}

// The smallest number of spans below `accepted` that is accepted, or that itself.
std::size_t SpanSearch::search_below(std::size_t accepted) {
  std::size_t rejected = lowest_ - 1;
  std::size_t spans = clamped((quick_ ? 1 : kFirstShare) * start_.total(), lowest_, accepted - 1);
  std::size_t further = 0;  // grows with each rejection: few attempts even if none succeeds
  while (accepted - rejected > 1 + (accepted <= highest_ ? accepted / kFineSpans : 0)) {
    const bool good = attempt(spans);
    (good ? accepted : rejected) = spans;
    if (good) keep();
    if (accepted - rejected <= 1 || (good && no_fewer(spans, rejected))) break;
    const std::size_t low = rejected + 1, high = accepted - 1;
    spans = clamped(start_.total(), low, high);
    if (good) continue;
    const double share = quick_ && balancings_ > 0 ? kNextShareBalanced : kNextShare;
    spans = std::max({spans, clamped(share * needed_, low, high), std::min(low + further / 4, high)});
    further = 2 * further + 1;
  }
  return accepted;
}

// Whether one span less than an accepted number is not worth the attempt.
bool SpanSearch::no_fewer(std::size_t accepted, std::size_t rejected) const {
  if (thorough_ || accepted - rejected > 2 + accepted / 16) return false;
  const auto spans = static_cast<double>(accepted);
  const double expected = fit_.worst_error() * fourth_power(spans / (spans - 1));
  return expected > (balancings_ == 0 ? kFewerUntouched : kFewerBalanced);
}

bool SpanSearch::accept(std::span<const double> breaks) {
  breaks_.assign(breaks.begin(), breaks.end());
  if (!fit_.fit(breaks_, kLastRounds) || !fit_.accepted()) return false;
  keep();
  return true;
}

// With the knots of the best fit so far; if thorough, also with those that the points alone ask for.
bool SpanSearch::attempt(std::size_t spans) {
  const bool known = std::isfinite(start_error_);
  return try_density(KnotDensity(start_), spans) || (known && thorough_ && try_density(first_, spans));
}

// Fits with this number of spans, moving the knots to where the errors are.
bool SpanSearch::try_density(KnotDensity density, std::size_t spans) {
  fit_.set_parameters(start_parameters_);
  double smallest = std::numeric_limits<double>::infinity(), power = kPower;
  for (balancings_ = 0; balancings_ <= kMostBalancings; ++balancings_) {
    density.distribute(spans, breaks_);
    const bool first = !std::isfinite(start_error_);  // its parameters are estimates
    if (!fit_.fit(breaks_, first ? kLastRounds : rounds_)) return false;
    const bool good = fit_.accepted();
    const double worst = fit_.worst_error();
    // With as much progress again, a quick search would still not be there.
    const bool slow = quick_ && worst * worst > kNearly * smallest;
    const bool stalled = slow || worst > kProgress * smallest;
    if (worst > smallest) power /= 2;
    smallest = std::min(smallest, worst);
    balance(density, power);
    needed_ = static_cast<double>(spans) * std::pow(worst, 0.25);
    if (worst < start_error_) {
      start_error_ = worst;
      start_parameters_ = fit_.parameters();
      start_ = density;
    }
    if (good) return true;
    // The balanced measure counts spans of error 1 (with the exponent of its step).
    const double balanced = std::pow(density.total() / static_cast<double>(spans), 1 / kPower);
    if (worst > kHopeless || balanced > kHopelessBalanced) return false;
    if (worst > kNearly && (balancings_ == kBalancings || (stalled && !thorough_))) return false;
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
