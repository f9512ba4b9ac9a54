#pragma once

// Profiles: the distinct samples of a plane curve, and where they turn.

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "sweep/sampling.hpp"

namespace meshcontour::detail {

struct ProfilePoint {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  Eigen::Vector2d before = Eigen::Vector2d::Zero(),
                  after = Eigen::Vector2d::Zero();  ///< tangents of length 1
  std::size_t sample = 0;                           ///< of the curve
};

struct Profile {
  std::vector<ProfilePoint> points;
  bool closed = false;  ///< the last point is followed by the first

  /// Twice the signed area that the points enclose; counter-clockwise is positive.
  double doubled_area() const;
};

/// Half-open range of spans (between consecutive points) or of points; the end may pass the number of points
/// of a closed sequence.
struct Range {
  std::size_t begin = 0, end = 0;
  std::size_t size() const { return end - begin; }
};

/// The distinct points of a plane curve. Where it turns by no more than `corner_angle` it is smooth.
Profile make_profile(const SampledCurve& curve, double corner_angle);

/// True at a point where a profile has a corner.
inline bool is_corner(const ProfilePoint& point) {
  return point.before != point.after;
}

/// Splits 0..spans at the corners (sorted). A closed sequence without corners is one range; one with corners
/// starts at the first of them.
std::vector<Range> split_at_corners(const std::vector<std::size_t>& corners, std::size_t spans, bool closed);

/// The smooth stretches of a profile, as ranges of spans.
std::vector<Range> smooth_stretches(const Profile& profile);

}  // namespace meshcontour::detail
