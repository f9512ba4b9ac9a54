#include "fit/calm.hpp"

#include <algorithm>
#include <cmath>

namespace meshcontour::detail {
namespace {

constexpr double kCalm = 1.75;  // share of the implied sagitta

}  // namespace

std::vector<double> calm_limits(std::span<const Point> points, bool closed, double tolerance) {
  const std::size_t n = points.size(), chords = closed ? n : n - 1;
  const auto chord = [&](std::size_t i) -> Vector { return points[(i + 1) % n] - points[i % n]; };
  const auto turning = [&](std::size_t i) {  // at the start of chord i; i == n: of chord 0
    if (!closed && (i == 0 || i == chords)) return 0.0;
    const Vector before = chord(i + n - 1), after = chord(i);
    return std::atan2(before.cross(after).norm(), before.dot(after));
  };
  std::vector<double> limits(chords);
  double at_start = turning(0);
  for (std::size_t i = 0; i < chords; ++i) {
    const double at_end = turning(i + 1);
    limits[i] = tolerance + kCalm * chord(i).norm() / 2 * std::tan(std::max(at_start, at_end) / 4);
    at_start = at_end;
  }
  return limits;
}

}  // namespace meshcontour::detail
