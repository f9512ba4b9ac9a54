// Sweep curves as exact curves, and with frames.

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "meshcontour/sweep.hpp"
#include "sweep/frames.hpp"

namespace meshcontour {

using namespace detail;

namespace {

// Knots 0 1 2 ... k, with multiplicity 4 at the ends and 3 inside.
std::vector<double> bezier_knots(std::size_t pieces) {
  std::vector<double> knots = {0};
  for (std::size_t i = 0; i <= pieces; ++i) knots.insert(knots.end(), 3, static_cast<double>(i));
  knots.push_back(static_cast<double>(pieces));
  return knots;
}

std::vector<double> uniform_knots(std::size_t count) {
  std::vector<double> knots(count);
  for (std::size_t i = 0; i < count; ++i) knots[i] = static_cast<double>(i);
  return knots;
}

Curve full_circle(double radius) {
  CircularArc circle;
  circle.start = circle.end = {radius, 0, 0};
  circle.radius = radius;
  circle.angle = 2 * std::numbers::pi;
  return circle;
}

}  // namespace

std::size_t SweepCurve::pieces() const {
  switch (kind) {
    case Kind::Bezier:
      return (control_points.size() - 1) / 3;
    case Kind::BSpline:
      return control_points.size() - 3;
    default:
      return 1;
  }
}

Curve to_curve(const SweepCurve& curve) {
  if (curve.kind == SweepCurve::Kind::Circle) return full_circle(curve.radius);
  BSplineCurve spline;
  spline.control_points = curve.control_points;
  if (curve.kind == SweepCurve::Kind::Bezier) {
    spline.knots = bezier_knots(curve.pieces());
    return spline;
  }
  const auto& points = curve.control_points;
  spline.knots = uniform_knots(points.size() + 4);
  spline.periodic = points.size() >= 6 && std::equal(points.begin(), points.begin() + 3, points.end() - 3);
  return spline;
}

FramedCurve frame_curve(const SweepCurve& curve, const SweepOptions& options) {
  if (curve.pieces() * curve.steps > options.max_triangles / 2) {
    throw Error(
        ErrorCode::OutOfMemory,
        fmt::format("the curve asks for more than the limit of {} samples", options.max_triangles / 2),
        curve.spot);
  }
  const SampledCurve samples = sample_curve(curve);
  FramedCurve framed;
  framed.closed = samples.closed;
  framed.smooth = samples.smooth;
  framed.length = samples.length;
  if (!samples.has_tangents()) return framed;
  const CarriedFrames frames = carry_frames(samples, options.frames);
  framed.closing_angle = frames.closing_angle;
  framed.frames = frames_of(samples, frames);
  return framed;
}

}  // namespace meshcontour
