#include "sweep/frames.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace meshcontour::detail {
namespace {

constexpr double kTiny = 1e-6;          // sine below which a cross product has no direction
constexpr double kSameFraction = 1e-9;  // of the size of a curve

Vector without_part_along(const Vector& v, const Vector& direction) {
  return (v - v.dot(direction) * direction).normalized();
}

// The smallest rotation that takes one tangent to the other; half a turn is taken about the binormal.
Vector rotate_least(const Vector& normal, const Vector& from, const Vector& to) {
  const double cosine = from.dot(to);
  if (1 + cosine < kTiny * kTiny) return without_part_along(-normal, to);
  return without_part_along(normal - normal.dot(to) / (1 + cosine) * (from + to), to);
}

// From sample to sample, on the far side of the first to the near side of the second; then across the corner
// there.
using Step = Vector (*)(const Vector& normal, const CurveSample& from, const CurveSample& to, double closest);

Vector double_reflection(const Vector& normal, const CurveSample& from, const CurveSample& to,
                         double closest) {
  return reflect_twice(normal, from.after.tangent, to.position - from.position, to.before.tangent, closest);
}

Vector project(const Vector& normal, const Vector& from_tangent, const Vector& tangent) {
  const Vector carried = from_tangent.cross(normal).cross(tangent);
  return carried.norm() < kTiny ? rotate_least(normal, from_tangent, tangent) : carried.normalized();
}

Vector projection(const Vector& normal, const CurveSample& from, const CurveSample& to, double) {
  return project(normal, from.after.tangent, to.before.tangent);
}

void carry(const SampledCurve& curve, Step step, std::vector<Vector>& before, std::vector<Vector>& after) {
  const auto& samples = curve.samples;
  after[0] = before[0] = start_normal(samples[0].after.tangent);
  for (std::size_t i = 1; i < samples.size(); ++i) {
    before[i] = step(after[i - 1], samples[i - 1], samples[i], kSameFraction * curve.size);
    after[i] = rotate_least(before[i], samples[i].before.tangent, samples[i].after.tangent);
  }
}

// In the plane z = constant: left of the direction of travel.
void point_left(const SampledCurve& curve, std::vector<Vector>& before, std::vector<Vector>& after) {
  for (std::size_t i = 0; i < curve.samples.size(); ++i) {
    before[i] = Vector::UnitZ().cross(curve.samples[i].before.tangent);
    after[i] = Vector::UnitZ().cross(curve.samples[i].after.tangent);
  }
}

// Towards the centre of curvature. Straight runs carry the normal on; one at the start takes that of its end.
void point_inward(const SampledCurve& curve, std::vector<Vector>& before, std::vector<Vector>& after) {
  const auto& samples = curve.samples;
  const double closest = kSameFraction * curve.size;
  const auto curvature = [](const Motion& motion) -> Vector { return motion.turn / motion.speed; };
  const auto bent = [&](const Motion& motion) {
    return motion.speed > 0 ? curvature(motion).norm() * curve.size > kTiny : motion.turn.norm() > 0;
  };
  const auto normal_of = [&](const Motion& motion, const Vector& carried) -> Vector {
    return bent(motion) ? without_part_along(motion.turn, motion.tangent) : carried;
  };
  std::size_t first = 0;
  while (first + 1 < samples.size() && !bent(samples[first].after)) ++first;
  Vector normal = normal_of(samples[first].after, start_normal(samples[first].after.tangent));
  for (std::size_t i = first + 1; i-- > 0;) {
    after[i] = before[i] = without_part_along(normal, samples[i].after.tangent);
    normal = after[i];
  }
  for (std::size_t i = 1; i < samples.size(); ++i) {
    before[i] =
        normal_of(samples[i].before, double_reflection(after[i - 1], samples[i - 1], samples[i], closest));
    after[i] = normal_of(samples[i].after,
                         rotate_least(before[i], samples[i].before.tangent, samples[i].after.tangent));
  }
}

void turn(SampleFrame& frame, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  const Vector normal = c * frame.normal + s * frame.binormal;
  frame.binormal = c * frame.binormal - s * frame.normal;
  frame.normal = normal;
}

// The part of the closing angle that a sample takes.
double share(const SampledCurve& curve, FrameMethod method, std::size_t i) {
  if (method == FrameMethod::RotationMinimizing) return curve.samples[i].arc / curve.length;
  return static_cast<double>(i) / static_cast<double>(curve.samples.size() - 1);
}

void close_up(const SampledCurve& curve, FrameMethod method, CarriedFrames& frames) {
  const SampleFrame &first = frames.after.front(), &last = frames.before.back();
  frames.closing_angle = std::atan2(first.normal.dot(last.binormal), first.normal.dot(last.normal));
  for (std::size_t i = 0; i < curve.samples.size(); ++i) {
    const double angle = frames.closing_angle * share(curve, method, i);
    turn(frames.before[i], angle);
    turn(frames.after[i], angle);
  }
}

// The twist between neighbouring samples, measured against double reflection; each sample takes the mean of
// its two.
std::vector<double> measured_twist(const SampledCurve& curve, const CarriedFrames& frames) {
  const auto& samples = curve.samples;
  const double closest = kSameFraction * curve.size;
  std::vector<double> twist(samples.size(), 0), weight(samples.size(), 0);
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const Vector carried = double_reflection(frames.after[i - 1].normal, samples[i - 1], samples[i], closest);
    const SampleFrame& frame = frames.before[i];
    const double angle =
        std::atan2(samples[i].before.tangent.dot(carried.cross(frame.normal)), carried.dot(frame.normal));
    const double length = samples[i].arc - samples[i - 1].arc;
    for (const std::size_t end : {i - 1, i}) {
      twist[end] += angle;
      weight[end] += length;
    }
  }
  for (std::size_t i = 0; i < twist.size(); ++i) twist[i] = weight[i] > 0 ? twist[i] / weight[i] : 0;
  return twist;
}

}  // namespace

Vector start_normal(const Vector& tangent) {
  const Vector across = Vector::UnitZ().cross(tangent);
  return across.norm() < kTiny ? Vector::UnitY().cross(tangent).normalized() : across.normalized();
}

Vector reflect_twice(const Vector& normal, const Vector& tangent, const Vector& step,
                     const Vector& next_tangent, double closest) {
  const double length = step.norm();
  if (length <= closest || length == 0) return rotate_least(normal, tangent, next_tangent);
  const Vector across = step / length;
  const Vector normal1 = normal - 2 * across.dot(normal) * across;
  const Vector tangent1 = tangent - 2 * across.dot(tangent) * across;
  const Vector second = next_tangent - tangent1;
  const double c2 = second.squaredNorm();
  if (c2 < kTiny * kTiny) return without_part_along(normal1, next_tangent);
  return without_part_along(normal1 - (2 / c2) * second.dot(normal1) * second, next_tangent);
}

CarriedFrames carry_frames(const SampledCurve& curve, FrameMethod method) {
  const std::size_t count = curve.samples.size();
  std::vector<Vector> before(count), after(count);
  const bool carried = method != FrameMethod::Frenet && !curve.planar;
  if (carried) {
    carry(curve, method == FrameMethod::Projection ? projection : double_reflection, before, after);
  } else {
    (method == FrameMethod::Frenet ? point_inward : point_left)(curve, before, after);
  }
  CarriedFrames frames;
  frames.before.reserve(count);
  frames.after.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    frames.before.push_back({before[i], curve.samples[i].before.tangent.cross(before[i])});
    frames.after.push_back({after[i], curve.samples[i].after.tangent.cross(after[i])});
  }
  if (carried && curve.smooth) close_up(curve, method, frames);
  const bool even = method == FrameMethod::RotationMinimizing;
  frames.twist = even ? std::vector<double>(count, curve.length > 0 ? frames.closing_angle / curve.length : 0)
                      : measured_twist(curve, frames);
  return frames;
}

std::vector<CurveFrame> frames_of(const SampledCurve& curve, const CarriedFrames& frames) {
  std::vector<CurveFrame> result;
  result.reserve(curve.samples.size());
  for (std::size_t i = 0; i < curve.samples.size(); ++i) {
    const CurveSample& sample = curve.samples[i];
    const SampleFrame& frame = frames.after[i];
    result.push_back({sample.position, sample.after.tangent, frame.normal, frame.binormal});
  }
  return result;
}

}  // namespace meshcontour::detail
