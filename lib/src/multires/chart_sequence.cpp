#include "multires/chart_sequence.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace meshcontour::detail {
namespace {

using PlanePoint = ChartSequence::PlanePoint;

double doubled_area(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

}  // namespace

ChartSequence::ChartSequence(std::size_t triangles)
    : triangles_(static_cast<Index>(triangles)), current_(triangles), first_point_{0}, first_before_{0} {
  std::iota(current_.begin(), current_.end(), Index{0});
}

void ChartSequence::add(std::span<const PlanePoint> points, std::span<const Face> before,
                        std::span<const Face> after) {
  const auto change = static_cast<Index>(first_point_.size() - 1);
  points_.insert(points_.end(), points.begin(), points.end());
  for (const Face& face : before) before_.push_back({current_[face.slot], face.corners});
  for (const Face& face : after) {
    current_[face.slot] = triangles_ + static_cast<Index>(made_.size());
    made_.push_back({change, face.corners});
  }
  first_point_.push_back(points_.size());
  first_before_.push_back(before_.size());
}

// The triangle that holds p, or the one that p is least outside of; rounding puts it there.
ChartSequence::Version ChartSequence::locate(Index change, const PlanePoint& p,
                                             std::array<double, 3>& weights) const {
  const PlanePoint* const points = points_.data() + first_point_[change];
  Version best;
  double best_least = -std::numeric_limits<double>::infinity();
  for (std::size_t i = first_before_[change]; i < first_before_[change + 1] && best_least < 0; ++i) {
    const auto [a, b, c] = before_[i].corners;
    const std::array<double, 3> areas = {doubled_area(p, points[b], points[c]),
                                         doubled_area(points[a], p, points[c]),
                                         doubled_area(points[a], points[b], p)};
    const double whole = areas[0] + areas[1] + areas[2];
    const double least = std::ranges::min(areas) / whole;
    if (!(least > best_least)) continue;
    best = before_[i];
    best_least = least;
    for (std::size_t k = 0; k < 3; ++k) weights[k] = areas[k] / whole;
  }
  double sum = 0;
  for (double& weight : weights) sum += weight = std::max(weight, 0.0);
  for (double& weight : weights) weight /= sum;
  return best;
}

SurfacePlace ChartSequence::origin(const SurfacePlace& place) const {
  Index version = current_[place.triangle];
  std::array<double, 3> weights = place.weights;
  while (version >= triangles_) {
    const Made& made = made_[version - triangles_];
    const PlanePoint* const points = points_.data() + first_point_[made.change];
    PlanePoint p = PlanePoint::Zero();
    for (std::size_t k = 0; k < 3; ++k) p += weights[k] * points[made.corners[k]];
    version = locate(made.change, p, weights).number;
  }
  return {version, weights};
}

}  // namespace meshcontour::detail
