#include "meshcontour/curve.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/conic.hpp"

namespace meshcontour {
namespace {

constexpr double kFullTurn = 2 * std::numbers::pi;
constexpr double kFullTurnSlack = 1e-9;  // radians: an arc this close to a full turn is one

Point at_fraction(const detail::ConicFrame& frame, double s) {
  if (s <= 0) return frame.start;
  if (s >= 1) return frame.end;
  return frame.at(frame.begin + s * frame.angle);
}

Point at_fraction(const LineSegment& line, double s) {
  if (s <= 0) return line.start;
  if (s >= 1) return line.end;
  return line.start + s * (line.end - line.start);
}

Point at_fraction(const BSplineCurve& curve, double s) {
  const auto [begin, end] = curve.domain();
  if (s <= 0) return evaluate(curve, begin);
  if (s >= 1) return evaluate(curve, end);
  return evaluate(curve, begin + s * (end - begin));
}

Point at_fraction(const CircularArc& arc, double s) {
  return at_fraction(detail::conic_frame(arc), s);
}
Point at_fraction(const EllipticalArc& arc, double s) {
  return at_fraction(detail::conic_frame(arc), s);
}

}  // namespace

bool CircularArc::full() const {
  return angle >= kFullTurn - kFullTurnSlack;
}

bool EllipticalArc::full() const {
  return angle >= kFullTurn - kFullTurnSlack;
}

Vector EllipticalArc::minor() const {
  return ratio * axis.cross(major);
}

double EllipticalArc::start_parameter() const {
  const Vector to_start = start - center;
  const double along_minor = axis.cross(major).dot(to_start) / ratio;
  const double t = std::atan2(along_minor, major.dot(to_start));
  return t < 0 ? t + kFullTurn : t;
}

std::pair<double, double> BSplineCurve::domain() const {
  return {knots[static_cast<std::size_t>(degree)], knots[control_points.size()]};
}

namespace detail {

ConicFrame conic_frame(const CircularArc& arc) {
  const Vector to_start = arc.start - arc.center;
  const Vector first = arc.radius * (to_start - to_start.dot(arc.axis) * arc.axis).normalized();
  return {arc.center, first, arc.axis.cross(first), 0, arc.angle, arc.start, arc.end};
}

ConicFrame conic_frame(const EllipticalArc& arc) {
  return {arc.center, arc.major, arc.minor(), arc.start_parameter(), arc.angle, arc.start, arc.end};
}

}  // namespace detail

Point evaluate(const Curve& curve, double s) {
  return std::visit([&](const auto& c) { return at_fraction(c, s); }, curve);
}

}  // namespace meshcontour
