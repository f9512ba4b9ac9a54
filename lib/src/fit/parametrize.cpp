#include "fit/parametrize.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meshcontour::detail {
namespace {

constexpr double kCalm = 1.75;  // sagittas
constexpr double kLargestTurning = 40 * std::numbers::pi / 180;

// Length of an arc over its chord, for arcs that turn by a. The series is exact to 1e-11 up to the largest
// turning.
double arc_over_chord(double a) {
  const double x = a * a / 4;
  return 1 +
         x * (1.0 / 6 + x * (7.0 / 360 + x * (31.0 / 15120 + x * (127.0 / 604800 + x * (73.0 / 3421440)))));
}

double quarter_tangent(double angle) {
  const double x = angle * angle / 16;
  // tan(angle / 4), as a series where that is exact to 1e-12.
  return angle < 0.3 ? angle / 4 * (1 + x * (1.0 / 3 + x * (2.0 / 15 + x * 17.0 / 315)))
                     : std::tan(angle / 4);
}

}  // namespace

ChordGeometry chord_geometry(std::span<const Point> points, bool closed) {
  const std::size_t n = points.size(), chords = closed ? n : n - 1;
  ChordGeometry result;
  result.parameters.reserve(chords + 1);
  result.sagittas.reserve(chords);
  const auto chord = [&](std::size_t i) -> Vector { return points[i + 1 < n ? i + 1 : 0] - points[i]; };
  const auto turning = [](const Vector& before, const Vector& after) {
    return std::atan2(before.cross(after).norm(), before.dot(after));
  };
  Vector current = chord(0);
  double at_start = closed ? turning(chord(n - 1), current) : 0;
  const double first = at_start;
  double t = 0;
  for (std::size_t i = 0; i < chords; ++i) {
    const bool last = i + 1 == chords;
    const Vector next = last ? current : chord(i + 1);
    const double at_end = !last ? turning(current, next) : closed ? first : 0;
    const double length = current.norm();
    result.parameters.push_back(t);
    result.sagittas.push_back(length / 2 * quarter_tangent(std::max(at_start, at_end)));
    const double start = !closed && i == 0 ? at_end : at_start, end = !closed && last ? at_start : at_end;
    t += length * arc_over_chord(std::min((start + end) / 2, kLargestTurning));
    current = next;
    at_start = at_end;
  }
  result.parameters.push_back(t);
  return result;
}

std::vector<double> calm_limits(std::span<const double> sagittas, double tolerance) {
  std::vector<double> limits;
  limits.reserve(sagittas.size());
  for (const double sagitta : sagittas) limits.push_back(tolerance + kCalm * sagitta);
  return limits;
}

}  // namespace meshcontour::detail
