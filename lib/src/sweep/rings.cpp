#include "sweep/rings.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace meshcontour::detail {
namespace {

constexpr double kLongestMitre = 2;  // 1 / cos(120 degrees / 2)
constexpr double kOpposite = 179 * std::numbers::pi / 180;

RingSide make_side(const Motion& motion, const SampleFrame& frame, double twist) {
  RingSide side;
  side.tangent = motion.tangent;
  side.normal = frame.normal;
  side.binormal = frame.binormal;
  side.speed = motion.speed;
  side.turn_x = motion.turn.dot(frame.normal);
  side.turn_y = motion.turn.dot(frame.binormal);
  side.twist = twist * motion.speed;
  return side;
}

// The part of v in the plane of the corner is stretched into the bisecting plane.
Vector mitred(const Vector& v, const Vector& tangent, const Vector& next_tangent) {
  const Vector axis = tangent.cross(next_tangent).normalized();
  const Vector across = axis.cross(tangent), bisecting = axis.cross((tangent + next_tangent).normalized());
  return v.dot(axis) * axis + v.dot(across) * std::min(1 / bisecting.dot(across), kLongestMitre) * bisecting;
}

Ring make_ring(const SampledCurve& sweep, const CarriedFrames& frames, std::size_t arrival,
               std::size_t departure, double corner_angle) {
  const CurveSample &in = sweep.samples[arrival], &out = sweep.samples[departure];
  Ring ring;
  ring.origin = in.position;
  ring.after = make_side(out.after, frames.after[departure], frames.twist[departure]);
  ring.before = make_side(in.before, frames.before[arrival], frames.twist[arrival]);
  const double angle = angle_between(in.before.tangent, out.after.tangent);
  if (angle <= corner_angle) {
    ring.before = ring.after;
  } else {
    ring.corner = angle;
  }
  ring.along_x = ring.before.normal;
  ring.along_y = ring.before.binormal;
  if (ring.corner > 0 && ring.corner < kOpposite) {
    ring.along_x = mitred(ring.along_x, ring.before.tangent, ring.after.tangent);
    ring.along_y = mitred(ring.along_y, ring.before.tangent, ring.after.tangent);
  }
  return ring;
}

}  // namespace

Vector RingSide::surface_normal(const Eigen::Vector2d& p, const Eigen::Vector2d& profile_tangent) const {
  const Vector n = progress(p) * (profile_tangent.y() * normal - profile_tangent.x() * binormal) +
                   twist * p.dot(profile_tangent) * tangent;
  const double length = n.norm();
  return length > 0 ? Vector(n / length) : Vector(Vector::Zero());
}

Rings make_rings(const SampledCurve& sweep, const CarriedFrames& frames, double corner_angle) {
  Rings result;
  result.wraps = sweep.smooth;
  const std::vector<std::size_t> kept = distinct_samples(sweep, result.wraps);
  result.rings.reserve(kept.size());
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const std::size_t departure = last_at_point(sweep, kept, i, result.wraps);
    result.rings.push_back(make_ring(sweep, frames, kept[i], departure, corner_angle));
  }
  return result;
}

std::vector<Range> smooth_runs(const Rings& rings) {
  std::vector<std::size_t> corners;
  const std::size_t count = rings.rings.size();
  for (std::size_t i = 0; i < count; ++i) {
    const bool inner = rings.wraps || (i > 0 && i + 1 < count);
    if (inner && rings.rings[i].corner > 0) corners.push_back(i);
  }
  return split_at_corners(corners, rings.wraps ? count : count - 1, rings.wraps);
}

}  // namespace meshcontour::detail
