// Reversal and affine maps.

#include <algorithm>
#include <cmath>
#include <optional>

#include "meshcontour/curve.hpp"
#include "model/conic.hpp"

namespace meshcontour {
namespace {

using Linear = Eigen::Matrix3d;

constexpr double kSimilaritySlack = 1e-12;  // relative, on squared scales
constexpr double kFlat = 1e-12;             // an ellipse with a smaller axis ratio has no plane of its own

LineSegment backwards(const LineSegment& line) {
  return {line.end, line.start};
}

template <typename Arc>
Arc backwards(Arc arc) {
  std::swap(arc.start, arc.end);
  arc.axis = -arc.axis;
  return arc;
}

template <>
BSplineCurve backwards(BSplineCurve curve) {
  const auto [begin, end] = curve.domain();
  std::ranges::reverse(curve.control_points);
  std::ranges::reverse(curve.weights);
  std::ranges::reverse(curve.knots);
  for (double& knot : curve.knots) {  // both ends exactly, whatever the rounding of their sum
    knot = knot == end ? begin : knot == begin ? end : begin + (end - knot);
  }
  return curve;
}

// The scale of a map that keeps shapes, mirrored or not.
std::optional<double> similarity_scale(const Linear& linear) {
  const Linear gram = linear.transpose() * linear;
  const double squared = gram.trace() / 3;
  const bool similar =
      (gram - squared * Linear::Identity()).cwiseAbs().maxCoeff() <= kSimilaritySlack * squared;
  if (!similar || !(squared > 0)) return std::nullopt;
  return std::sqrt(squared);
}

BSplineCurve placed(BSplineCurve curve, const Eigen::Affine3d& placement) {
  for (Point& p : curve.control_points) p = placement * p;
  return curve;
}

LineSegment placed(const LineSegment& line, const Eigen::Affine3d& placement) {
  return {placement * line.start, placement * line.end};
}

// The principal axes of the image of the conic [Rytz's construction, in the closed form of a 2 x 2 rotation].
template <typename Arc>
Curve placed_conic(const Arc& arc, const Eigen::Affine3d& placement) {
  const detail::ConicFrame frame = detail::conic_frame(arc);
  const Vector first = placement.linear() * frame.first, second = placement.linear() * frame.second;
  const double turn = std::atan2(2 * first.dot(second), first.squaredNorm() - second.squaredNorm()) / 2;
  const Vector major = std::cos(turn) * first + std::sin(turn) * second;
  const Vector minor = std::cos(turn) * second - std::sin(turn) * first;
  const Vector normal = first.cross(second);
  if (!(normal.norm() > kFlat * major.squaredNorm())) return placed(to_clamped_bspline(arc), placement);
  return EllipticalArc{placement * arc.start,
                       placement * arc.end,
                       placement * arc.center,
                       normal.normalized(),
                       major,
                       std::min(1.0, minor.norm() / major.norm()),
                       arc.angle};
}

// The side to which the image of the plane with this normal faces: turned with the map, and back if it
// mirrors.
Vector placed_axis(const Vector& axis, const Linear& linear) {
  const Vector image = linear * axis;
  return (linear.determinant() < 0 ? Vector(-image) : image).normalized();
}

Curve placed(const CircularArc& arc, const Eigen::Affine3d& placement) {
  const auto scale = similarity_scale(placement.linear());
  if (!scale) return placed_conic(arc, placement);
  return CircularArc{placement * arc.start,  placement * arc.end,
                     placement * arc.center, placed_axis(arc.axis, placement.linear()),
                     arc.radius * *scale,    arc.angle};
}

Curve placed(const EllipticalArc& arc, const Eigen::Affine3d& placement) {
  if (!similarity_scale(placement.linear())) return placed_conic(arc, placement);
  EllipticalArc result = arc;
  result.start = placement * arc.start;
  result.end = placement * arc.end;
  result.center = placement * arc.center;
  result.axis = placed_axis(arc.axis, placement.linear());
  result.major = placement.linear() * arc.major;
  return result;
}

}  // namespace

Curve reversed(const Curve& curve) {
  return std::visit([](const auto& c) -> Curve { return backwards(c); }, curve);
}

Curve transformed(const Curve& curve, const Eigen::Affine3d& placement) {
  return std::visit([&](const auto& c) -> Curve { return placed(c, placement); }, curve);
}

}  // namespace meshcontour
