#include "fit/spline_fit.hpp"

#include <algorithm>
#include <cmath>

#include "fit/certificate.hpp"

namespace meshcontour::detail {
namespace {

constexpr double kLargestMove = 0.45;  // of the gap to a neighbour, so that the order is kept
constexpr double kHintWeight = 0.2;    // of a sample that is no vertex
constexpr double kSettled = 1e-4;  // squared slide over squared distance: another step would change nothing
constexpr int kLastSteps = 2;      // of Newton's method, after the last round of least squares

}  // namespace

SplineFit::SplineFit(const RunSamples& samples) : run_(samples), parameters_(samples.parameters) {
  const std::size_t n = samples.points.size();
  curve_.periodic = samples.closed;
  errors_.resize(n);
  accelerations_.resize(n);
  spans_.resize(n);
  if (samples.stride > 1) {
    std::vector<double> weights(n, kHintWeight);
    for (std::size_t i = 0; i < n; i += samples.stride) weights[i] = 1;
    solver_.set_weights(std::move(weights));
  }
}

void SplineFit::set_knots(std::span<const double> breaks) {
  const std::size_t spans = breaks.size() - 1;
  std::vector<double>& knots = curve_.knots;
  knots.resize(spans + 7);
  std::ranges::copy(breaks, knots.begin() + 3);
  for (std::size_t k = 1; k <= 3; ++k) {
    knots[3 - k] = run_.closed ? breaks[spans - k] - run_.end : breaks.front();
    knots[3 + spans + k] = run_.closed ? breaks[k] + run_.end : breaks.back();
  }
}

void SplineFit::update_pieces() {
  const std::size_t spans = curve_.knots.size() - 7;
  pieces_.clear();
  for (std::size_t k = 0; k < spans; ++k) {
    pieces_.emplace_back(curve_.knots.data() + 3 + k, curve_.control_points.data() + k);
  }
}

// The piece that holds u, which is moved into the domain of a closed curve.
std::size_t SplineFit::piece_at(double& u, std::size_t hint) const {
  if (run_.closed) u = u < 0 ? u + run_.end : u >= run_.end ? u - run_.end : u;
  const double* t = curve_.knots.data() + 3;
  while (hint > 0 && u < t[hint]) --hint;
  while (hint + 1 < pieces_.size() && u >= t[hint + 1]) ++hint;
  return hint;
}

void SplineFit::move_footpoints(int steps) {
  const std::size_t n = run_.points.size();
  std::swap(previous_, parameters_);
  parameters_.resize(n);
  std::size_t hint = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double before = i > 0 ? previous_[i - 1] : previous_[n - 1] - run_.end;
    const double after = i + 1 < n ? previous_[i + 1] : previous_[0] + run_.end;
    const double reach = kLargestMove * std::min(previous_[i] - before, after - previous_[i]);
    const bool fixed = !run_.closed && (i == 0 || i + 1 == n);
    double t = previous_[i];
    for (int step = 0; step < steps && !fixed; ++step) {
      double u = t;
      hint = piece_at(u, hint);
      const TaylorPiece& piece = pieces_[hint];
      const double s = u - piece.begin;
      const Vector gap = piece.position(s) - run_.points[i], velocity = piece.velocity(s);
      const double speed = velocity.squaredNorm(), curvature = speed + gap.dot(piece.acceleration(s));
      const double move = -gap.dot(velocity) / (curvature > speed / 4 ? curvature : speed);
      const double next = std::clamp(t + move, previous_[i] - reach, previous_[i] + reach);
      const bool settled = (next - t) * (next - t) * speed <= kSettled * gap.squaredNorm();
      t = next;
      if (settled) break;
    }
    parameters_[i] = t;
  }
}

void SplineFit::measure() {
  const std::size_t n = run_.points.size();
  std::size_t hint = 0;
  vertex_error_ = 0;
  for (std::size_t i = 0; i < n; ++i) {
    double u = parameters_[i];
    hint = piece_at(u, hint);
    const double s = u - pieces_[hint].begin;
    spans_[i] = static_cast<std::uint32_t>(hint);
    errors_[i] = (pieces_[hint].position(s) - run_.points[i]).norm();
    accelerations_[i] = pieces_[hint].acceleration(s).norm();
    if (i % run_.stride == 0) vertex_error_ = std::max(vertex_error_, errors_[i]);
  }
}

bool SplineFit::fit(std::span<const double> breaks, int rounds) {
  set_knots(breaks);
  for (int round = 0; round < rounds; ++round) {
    const bool solved =
        run_.closed ? solver_.solve_closed(curve_.knots, run_.points, parameters_, curve_.control_points)
                    : solver_.solve_open(curve_.knots, run_.points, parameters_, run_.tangents,
                                         curve_.control_points);
    if (!solved) return false;
    update_pieces();
    move_footpoints(round + 1 < rounds ? 1 : kLastSteps);
  }
  measure();
  return true;
}

// A curve whose ends are e0 and e1 from those of a chord is nowhere farther than max(e0, e1) + h^2/8 max
// |C''| from it; where that is not enough, the Bezier hull decides.
double SplineFit::chord_bound(std::size_t i) {
  const std::size_t n = run_.points.size(), next = i + run_.stride < n ? i + run_.stride : 0;
  const double limit = run_.limits[i / run_.stride];
  const double begin = parameters_[i], end = next > 0 ? parameters_[next] : parameters_[0] + run_.end;
  double acceleration = std::max(accelerations_[i], accelerations_[next]);
  for (std::size_t k = spans_[i]; k != spans_[next];) {
    k = k + 1 < pieces_.size() ? k + 1 : 0;
    acceleration = std::max(acceleration, 2 * pieces_[k].c2.norm());
  }
  const double step = end - begin;
  const double bound = std::max(errors_[i], errors_[next]) + step * step / 8 * acceleration;
  if (bound <= limit) return bound;
  return chord_deviation(curve_, begin, end, run_.points[i], run_.points[next], limit);
}

bool SplineFit::accepted() {
  const std::size_t n = run_.points.size();
  span_errors_.assign(pieces_.size(), 0.0);
  worst_error_ = 0;
  const auto add = [&](std::size_t i, double error) {
    span_errors_[spans_[i]] = std::max(span_errors_[spans_[i]], error);
    if (error > worst_error_) worst_chord_ = i;
    worst_error_ = std::max(worst_error_, error);
  };
  for (std::size_t i = 0; i < n; i += run_.stride) {
    add(i, errors_[i] / run_.tolerance);
    const std::size_t chord = i / run_.stride;
    if (chord >= run_.limits.size()) continue;
    const double bound = chord_bound(i);
    if (bound > run_.limits[chord]) add(i, bound / run_.limits[chord]);
  }
  return worst_error_ <= 1;
}

}  // namespace meshcontour::detail
