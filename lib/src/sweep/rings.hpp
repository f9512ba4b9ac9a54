#pragma once

// Where the copies of a profile stand along a sweep.

#include <vector>

#include "sweep/frames.hpp"
#include "sweep/profile.hpp"

namespace meshcontour::detail {

/// The frame of a ring as the surface on one side of it sees it; derivatives by the sweep's own parameter.
struct RingSide {
  Vector tangent, normal, binormal;
  double speed = 1;
  double turn_x = 0, turn_y = 0;  ///< dT/du along normal and binormal
  double twist = 0;               ///< about the tangent, radians a unit of the parameter

  /// d(point of the profile)/du along the tangent; negative where the profile reaches past the centre of
  /// curvature.
  double progress(const Eigen::Vector2d& p) const { return speed - turn_x * p.x() - turn_y * p.y(); }
  /// S_profile x S_sweep at a point of the profile with that tangent, of length 1 or zero.
  Vector surface_normal(const Eigen::Vector2d& p, const Eigen::Vector2d& profile_tangent) const;
};

/// A copy of the profile: origin + x along_x + y along_y.
struct Ring {
  Point origin;
  Vector along_x, along_y;  ///< at a mitre longer than 1
  RingSide before, after;
  double corner = 0;  ///< the angle by which the sweep turns here, radians; 0 where it is smooth
};

struct Rings {
  std::vector<Ring> rings;
  bool wraps = false;  ///< the last is followed by the first
};

/// The rings at the distinct samples of a curve that is not degenerate.
///
/// Where the curve turns by more than `corner_angle` the ring lies in the bisecting plane, as in a mitre
/// joint; the mitre grows no longer than it is at 120 degrees.
Rings make_rings(const SampledCurve& sweep, const CarriedFrames& frames, double corner_angle);

/// The runs without corners, as ranges of strips.
std::vector<Range> smooth_runs(const Rings& rings);

}  // namespace meshcontour::detail
