#include "fit/path.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fit/cleaning.hpp"

namespace meshcontour::detail {

namespace {

double angle_between(const Vector& a, const Vector& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

// Fills in what follows from the points.
void measure(Path& path) {
  const std::size_t n = path.points.size() - 1;
  path.length.resize(n);
  path.turn.assign(n + 1, std::numbers::pi);
  for (std::size_t i = 0; i < n; ++i) path.length[i] = (path.points[i + 1] - path.points[i]).norm();
  for (std::size_t i = 1; i < n; ++i) {
    path.turn[i] = angle_between(path.points[i] - path.points[i - 1], path.points[i + 1] - path.points[i]);
  }
  if (!path.closed || n == 0) return;
  path.turn[0] = angle_between(path.points[n] - path.points[n - 1], path.points[1] - path.points[0]);
  path.turn[n] = path.turn[0];
}

}  // namespace

const Point* Path::beyond(std::size_t position, std::ptrdiff_t steps) const {
  const auto n = static_cast<std::ptrdiff_t>(chords());
  std::ptrdiff_t at = static_cast<std::ptrdiff_t>(position) + steps;
  if (closed) at = ((at % n) + n) % n;
  return at >= 0 && at <= n ? &points[static_cast<std::size_t>(at)] : nullptr;
}

Path make_path(std::span<const Point> points, bool closed) {
  Path path;
  path.closed = closed;
  if (points.empty()) return path;
  CleanedPoints cleaned = clean_points(points, closed);
  path.origin = points[0];
  path.points = std::move(cleaned.points);
  path.source = std::move(cleaned.origin);
  path.extent = cleaned.diagonal;
  path.dropped = cleaned.dropped;
  for (Point& p : path.points) p -= path.origin;
  if (closed && path.points.size() > 1) {
    path.points.push_back(path.points[0]);
    path.source.push_back(path.source[0]);
  }
  measure(path);
  return path;
}

Path rotated(const Path& path, std::size_t start) {
  Path result = path;
  const auto turn_to = [&](auto& values, bool ring) {
    if (ring) values.pop_back();
    std::rotate(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(start), values.end());
    if (ring) values.push_back(values.front());
  };
  turn_to(result.points, true);
  turn_to(result.source, true);
  turn_to(result.turn, true);
  turn_to(result.length, false);
  return result;
}

}  // namespace meshcontour::detail
