#include "sweep/profile.hpp"

#include <cmath>

namespace meshcontour::detail {
namespace {

// Small kinks are smoothed, so that the patches on both sides share their normals.
void smooth_kink(ProfilePoint& point, double corner_angle) {
  const auto [a, b] = std::pair(point.before, point.after);
  if (a == b || std::abs(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b))) > corner_angle) return;
  point.before = point.after = (a + b).normalized();
}

}  // namespace

double Profile::doubled_area() const {
  if (points.empty()) return 0;
  double sum = 0;
  const Eigen::Vector2d origin = points.front().position;
  Eigen::Vector2d previous = points.back().position - origin;
  for (const ProfilePoint& point : points) {
    const Eigen::Vector2d current = point.position - origin;
    sum += previous.x() * current.y() - previous.y() * current.x();
    previous = current;
  }
  return sum;
}

Profile make_profile(const SampledCurve& curve, double corner_angle) {
  Profile profile;
  profile.closed = curve.closed;
  const std::vector<std::size_t> kept = distinct_samples(curve, curve.closed);
  profile.points.reserve(kept.size());
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const CurveSample& arrival = curve.samples[kept[i]];
    const CurveSample& departure = curve.samples[last_at_point(curve, kept, i, curve.closed)];
    ProfilePoint point;
    point.position = arrival.position.head<2>();
    point.before = arrival.before.tangent.head<2>();
    point.after = departure.after.tangent.head<2>();
    point.sample = kept[i];
    profile.points.push_back(point);
  }
  if (profile.closed) profile.points.front().before = curve.samples.back().before.tangent.head<2>();
  for (ProfilePoint& point : profile.points) smooth_kink(point, corner_angle);
  return profile;
}

std::vector<Range> split_at_corners(const std::vector<std::size_t>& corners, std::size_t spans, bool closed) {
  if (corners.empty()) return {{0, spans}};
  std::vector<Range> ranges;
  if (!closed && corners.front() > 0) ranges.push_back({0, corners.front()});
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) ranges.push_back({corners[i], corners[i + 1]});
  if (closed) {
    ranges.push_back({corners.back(), corners.front() + spans});
  } else if (corners.back() < spans) {
    ranges.push_back({corners.back(), spans});
  }
  return ranges;
}

std::vector<Range> smooth_stretches(const Profile& profile) {
  std::vector<std::size_t> corners;
  const std::size_t count = profile.points.size();
  for (std::size_t i = 0; i < count; ++i) {
    const bool inner = profile.closed || (i > 0 && i + 1 < count);
    if (inner && is_corner(profile.points[i])) corners.push_back(i);
  }
  return split_at_corners(corners, profile.closed ? count : count - 1, profile.closed);
}

}  // namespace meshcontour::detail
