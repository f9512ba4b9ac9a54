#pragma once

// Samples of sweep curves with tangents on both sides, arc length and curvature.

#include <cstddef>
#include <vector>

#include "meshcontour/sweep.hpp"

namespace meshcontour::detail {

/// Motion along a curve on one side of a point: dC/du = speed * tangent, dT/du = turn. u is the curve's
/// parameter, or, where the derivative vanishes, one with speed 1.
struct Motion {
  Vector tangent = Vector::Zero();  ///< of length 1; zero only where a curve is a single point
  double speed = 1;
  Vector turn = Vector::Zero();

  bool known() const { return tangent != Vector::Zero(); }
};

struct CurveSample {
  Point position = Point::Zero();
  Motion before, after;  ///< equal where the curve is smooth
  double arc = 0;        ///< arc length from the start, model units

  /// The angle by which the tangent turns here, radians.
  double turning_angle() const;
};

/// A sampled curve: pieces * steps + 1 samples; those of a closed curve end where they begin.
struct SampledCurve {
  std::vector<CurveSample> samples;
  bool planar = false;                  ///< in a plane of constant z
  bool closed = false, smooth = false;  ///< as in FramedCurve
  double standstill = 0;                ///< derivatives shorter than this vanish
  double size = 0;                      ///< diagonal of the box of the samples
  double length = 0;

  /// True if all samples are one point.
  bool degenerate() const { return size == 0; }
  /// False if the curve is one point; circles of radius 0 have tangents.
  bool has_tangents() const { return samples.front().after.known(); }
};

/// Samples the curve. Linear in the samples.
SampledCurve sample_curve(const SweepCurve& curve);

/// A spline between its samples; arc is not set.
///
/// @param standstill  as in SampledCurve.
/// @param parameter   counted in samples, from 0 to pieces * steps.
CurveSample sample_at(const SweepCurve& spline, double standstill, double parameter);

/// Indices of the samples to be meshed: without those that lie within 1e-9 of the curve's size from the one
/// before, and without those at the end that lie so near the first one if `wraps`.
std::vector<std::size_t> distinct_samples(const SampledCurve& curve, bool wraps);

/// The last sample at the point of the i-th distinct one: the curve leaves the point from there.
std::size_t last_at_point(const SampledCurve& curve, const std::vector<std::size_t>& distinct, std::size_t i,
                          bool wraps);

/// The angle between two directions, radians in [0, pi].
double angle_between(const Vector& a, const Vector& b);

/// (cos, sin) of 2 pi i / n, with all the symmetries of the circle kept exactly.
Eigen::Vector2d unit_circle_point(std::size_t i, std::size_t n);

}  // namespace meshcontour::detail
