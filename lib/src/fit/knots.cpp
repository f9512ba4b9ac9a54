#include "fit/knots.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace meshcontour::detail {
namespace {

constexpr double kErrorConstant =
    720;  // 4! times 30, the reciprocal of the largest value of the Bernoulli polynomial B4
constexpr double kFloor = 0.08;        // of the mean density
constexpr double kFullestCell = 0.95;  // spans
constexpr int kFillingRounds = 8;

// |c''''| at the middle of five points.
double fourth_derivative(std::span<const Point> points, std::span<const double> t, std::size_t first,
                         double period) {
  const std::size_t n = points.size();
  std::array<Vector, 5> difference;
  std::array<double, 5> at;
  for (std::size_t k = 0; k < 5; ++k) {
    const std::size_t i = first + k;
    difference[k] = points[i % n];
    at[k] = t[i % n] + static_cast<double>(i / n) * period;
  }
  for (std::size_t order = 1; order < 5; ++order) {
    for (std::size_t k = 0; k + order < 5; ++k) {
      difference[k] = (difference[k + 1] - difference[k]) / (at[k + order] - at[k]);
    }
  }
  return 24 * difference[0].norm();
}

}  // namespace

KnotDensity::KnotDensity(std::span<const Point> points, std::span<const double> parameters, bool closed,
                         double tolerance)
    : at_(parameters.begin(), parameters.end()), mass_(parameters.size() - 1, 1.0) {
  const std::size_t n = points.size();
  if (n < 5) return;
  const double period = closed ? parameters.back() - parameters.front() : 0;
  std::vector<double> wanted(n);  // spans a unit of the parameter, at each point
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t first = closed ? i + n - 2 : std::clamp<std::size_t>(i, 2, n - 3) - 2;
    wanted[i] =
        std::sqrt(std::sqrt(fourth_derivative(points, parameters, closed ? first % n : first, period) /
                            (kErrorConstant * tolerance)));
  }
  const double mean = std::accumulate(wanted.begin(), wanted.end(), 0.0) / static_cast<double>(n);
  for (std::size_t i = 0; i < mass_.size(); ++i) {
    const double density = (wanted[i] + wanted[(i + 1) % n]) / 2;
    mass_[i] = std::max(density, kFloor * mean + 1e-300) * (at_[i + 1] - at_[i]);
  }
  if (!closed) mass_.front() = mass_.back() = 0;
}

double KnotDensity::total() const {
  return std::accumulate(mass_.begin(), mass_.end(), 0.0);
}

// The factor that brings the measure to `spans` when cells that would hold more than `fullest` give the rest
// away.
double KnotDensity::filling(double spans, double fullest) const {
  double scale = spans / total();
  for (int round = 0; round < kFillingRounds; ++round) {
    double full = 0, rest = 0;
    for (const double mass : mass_) {
      const bool overfull = mass * scale >= fullest;
      (overfull ? full : rest) += overfull ? fullest : mass;
    }
    const double next = (spans - full) / rest;
    if (!(rest > 0 && next > scale * (1 + 1e-6))) break;
    scale = next;
  }
  return scale;
}

void KnotDensity::distribute(std::size_t spans, std::vector<double>& breaks) const {
  const auto cells = static_cast<double>(std::ranges::count_if(mass_, [](double mass) { return mass > 0; }));
  const auto wanted = static_cast<double>(spans);
  const double fullest = cells >= wanted ? std::max(kFullestCell, wanted / cells) : wanted;
  const double scale = filling(wanted, fullest);
  const auto cell_mass = [&](std::size_t i) { return std::min(mass_[i] * scale, fullest); };
  double sum = 0;
  for (std::size_t i = 0; i < mass_.size(); ++i) sum += cell_mass(i);
  const double step = sum / wanted;
  breaks.clear();
  breaks.push_back(at_.front());
  double passed = 0;
  for (std::size_t i = 0; i < mass_.size() && breaks.size() < spans; ++i) {
    const double mass = cell_mass(i);
    while (breaks.size() < spans && passed + mass >= step * static_cast<double>(breaks.size())) {
      const double share = (step * static_cast<double>(breaks.size()) - passed) / mass;
      breaks.push_back(at_[i] + share * (at_[i + 1] - at_[i]));
    }
    passed += mass;
  }
  while (breaks.size() < spans) breaks.push_back((breaks.back() + at_.back()) / 2);
  breaks.push_back(at_.back());
}

void KnotDensity::rescale(std::span<const double> breaks, std::span<const double> wanted) {
  // A cell that a knot cuts counts with both its parts.
  std::size_t cell = 0;
  std::vector<double> next(mass_.size(), 0.0);
  const auto share = [&](std::size_t i, double begin, double end) {
    const double low = std::max(begin, at_[i]), high = std::min(end, at_[i + 1]);
    return std::max(0.0, high - low) / (at_[i + 1] - at_[i]);
  };
  for (std::size_t span = 0; span < wanted.size(); ++span) {
    const double begin = breaks[span], end = breaks[span + 1];
    while (cell > 0 && at_[cell] > begin) --cell;
    while (cell + 1 < mass_.size() && at_[cell + 1] <= begin) ++cell;
    double inside = 0;
    std::size_t last = cell;
    for (; last < mass_.size() && at_[last] < end; ++last) inside += mass_[last] * share(last, begin, end);
    if (!(inside > 0)) continue;
    for (std::size_t i = cell; i < last; ++i)
      next[i] += mass_[i] * share(i, begin, end) * wanted[span] / inside;
    cell = last > 0 ? last - 1 : 0;
  }
  mass_ = std::move(next);
}

}  // namespace meshcontour::detail
