#include "fit/cleaning.hpp"

#include <algorithm>

namespace meshcontour::detail {
namespace {

void drop_last(CleanedPoints& cleaned, const Point& kept) {
  cleaned.dropped = std::max(cleaned.dropped, (cleaned.points.back() - kept).stableNorm());
  cleaned.points.pop_back();
  cleaned.origin.pop_back();
}

}  // namespace

double box_diagonal(std::span<const Point> points) {
  Box box;
  for (const Point& p : points) box.extend(p);
  return points.empty() ? 0 : box.diagonal().stableNorm();
}

CleanedPoints clean_points(std::span<const Point> points, bool closed) {
  CleanedPoints cleaned;
  cleaned.diagonal = box_diagonal(points);
  const double smallest = kRepeatedPoint * cleaned.diagonal;
  cleaned.points.reserve(points.size());
  cleaned.origin.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double step = cleaned.points.empty() ? 0 : (points[i] - cleaned.points.back()).stableNorm();
    if (!cleaned.points.empty() && step <= smallest) {
      cleaned.dropped = std::max(cleaned.dropped, step);
      continue;
    }
    cleaned.points.push_back(points[i]);
    cleaned.origin.push_back(i);
  }
  if (closed) {
    while (cleaned.points.size() > 1 &&
           (cleaned.points.back() - cleaned.points.front()).stableNorm() <= smallest) {
      const Point first = cleaned.points.front();
      drop_last(cleaned, first);
    }
  } else if (!points.empty() && cleaned.origin.back() + 1 != points.size() && cleaned.points.size() > 1) {
    const Point& last = points.back();
    while (cleaned.points.size() > 1 && (cleaned.points.back() - last).stableNorm() <= smallest) {
      drop_last(cleaned, last);
    }
    cleaned.points.push_back(last);
    cleaned.origin.push_back(points.size() - 1);
  }
  return cleaned;
}

}  // namespace meshcontour::detail
