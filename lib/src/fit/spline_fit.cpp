#include "fit/spline_fit.hpp"

#include <algorithm>
#include <cmath>

#include "fit/certificate.hpp"
#include "fit/sample_pairs.hpp"

namespace meshcontour::detail {
namespace {

constexpr double kLargestMove = 0.45;  // of the gap to a neighbour, so that the order is kept
constexpr double kHintWeight = 0.2;    // of a sample that is no vertex

}  // namespace

SplineFit::SplineFit(const RunSamples& samples) : run_(samples), parameters_(samples.parameters) {
  const std::size_t n = samples.points.size();
  curve_.periodic = samples.closed;
  at_points_.resize(n);
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

// How far each parameter may move in this round.
void SplineFit::limit_moves() {
  const std::size_t n = parameters_.size();
  const double* t = parameters_.data();
  earliest_.resize(n);
  latest_.resize(n);
  double before = run_.closed ? t[0] + run_.end - t[n - 1] : 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double after = i + 1 < n ? t[i + 1] - t[i] : run_.closed ? t[0] + run_.end - t[i] : 0;
    const double reach = kLargestMove * std::min(before, after);
    earliest_[i] = t[i] - reach;
    latest_[i] = t[i] + reach;
    before = after;
  }
}

// One step of Newton's method to the nearest points, nowhere more than twice that of Gauss and Newton.
void SplineFit::move_footpoints() {
  const auto move = [&](std::size_t span, std::size_t begin, std::size_t end, double shift) {
    const TaylorPiece& piece = pieces_[span];
    for (std::size_t i = begin; i < end; i += 2) {
      const std::size_t j = std::min(i + 1, end - 1);
      const Pair t{parameters_[i], parameters_[j]}, s = t + (shift - piece.begin);
      const PointPair gap = piece.gap(s, {run_.points[i], run_.points[j]}), velocity = piece.velocity(s);
      const Pair speed = velocity.dot(velocity), curvature = speed + gap.dot(piece.acceleration(s));
      const Pair next = t - gap.dot(velocity) / largest(curvature, 0.5 * speed);
      const Pair earliest{earliest_[i], earliest_[j]}, latest{latest_[i], latest_[j]};
      const Pair kept = smallest(largest(next, earliest), latest);
      parameters_[i] = kept[0];
      parameters_[j] = kept[1];
    }
  };
  for_each_span(curve_.knots.data() + 3, pieces_.size(), parameters_, move);
}

void SplineFit::measure() {
  const auto measure_span = [&](std::size_t span, std::size_t begin, std::size_t end, double shift) {
    const TaylorPiece& piece = pieces_[span];
    for (std::size_t i = begin; i < end; i += 2) {
      const std::size_t j = std::min(i + 1, end - 1);
      const Pair s = Pair{parameters_[i], parameters_[j]} + (shift - piece.begin);
      const PointPair gap = piece.gap(s, {run_.points[i], run_.points[j]}), bend = piece.acceleration(s);
      const Pair error = gap.dot(gap), acceleration = bend.dot(bend);
      at_points_[i] = {error[0], acceleration[0], span};
      at_points_[j] = {error[1], acceleration[1], span};
    }
  };
  for_each_span(curve_.knots.data() + 3, pieces_.size(), parameters_, measure_span);
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
    limit_moves();
    move_footpoints();
  }
  measure();
  return true;
}

// A curve whose ends are e0 and e1 from those of a chord is nowhere farther than max(e0, e1) + h^2/8 max
// |C''| from it; where that is not enough, the Bezier hull decides.
double SplineFit::chord_bound(std::size_t i) const {
  const std::size_t n = run_.points.size(), next = i + run_.stride < n ? i + run_.stride : 0;
  const AtPoint &first = at_points_[i], &last = at_points_[next];
  const double limit = run_.limits[i / run_.stride];
  const double begin = parameters_[i], end = next > 0 ? parameters_[next] : parameters_[0] + run_.end;
  double acceleration = std::max(first.acceleration, last.acceleration);
  for (std::size_t k = first.span; k != last.span;) {
    k = k + 1 < pieces_.size() ? k + 1 : 0;
    acceleration = std::max(acceleration, 4 * pieces_[k].c2.squaredNorm());
  }
  const double step = end - begin;
  const double bound =
      std::sqrt(std::max(first.error, last.error)) + step * step / 8 * std::sqrt(acceleration);
  if (bound <= limit) return bound;
  return chord_deviation(curve_, begin, end, run_.points[i], run_.points[next], limit);
}

bool SplineFit::accepted() {
  const std::size_t n = run_.points.size();
  span_errors_.assign(pieces_.size(), 0.0);
  double farthest = 0;
  for (std::size_t i = 0; i < n; i += run_.stride) {
    double& error = span_errors_[at_points_[i].span];
    error = std::max(error, at_points_[i].error);
    farthest = std::max(farthest, error);
  }
  vertex_error_ = std::sqrt(farthest);
  for (double& error : span_errors_) error = std::sqrt(error) / run_.tolerance;
  worst_error_ = vertex_error_ / run_.tolerance;
  if (worst_error_ > 1) return false;
  for (std::size_t chord = 0; chord < run_.limits.size(); ++chord) {
    const std::size_t i = chord * run_.stride;
    const double bound = chord_bound(i);
    if (bound <= run_.limits[chord]) continue;
    double& error = span_errors_[at_points_[i].span];
    error = std::max(error, bound / run_.limits[chord]);
    worst_error_ = std::max(worst_error_, error);
  }
  return worst_error_ <= 1;
}

}  // namespace meshcontour::detail
