#include "write/sampling.hpp"

#include <algorithm>
#include <cmath>

namespace meshcontour::detail {
namespace {

constexpr int kMostChords = 4096;

template <typename C>
Point first_point(const C& curve) {
  return curve.start;
}
template <>
Point first_point(const BSplineCurve& curve) {
  return evaluate(curve, curve.domain().first);
}

template <typename C>
Point last_point(const C& curve) {
  return curve.end;
}
template <>
Point last_point(const BSplineCurve& curve) {
  return evaluate(curve, curve.periodic ? curve.domain().first : curve.domain().second);
}

int bounded_count(double chords) {
  return chords < kMostChords ? std::max(1, static_cast<int>(std::ceil(chords))) : kMostChords;
}

void add_samples(const LineSegment&, double, std::vector<Point>&) {}

// A chord over the angle a is r (1 - cos(a / 2)) from its arc.
template <typename Arc>
void add_arc_samples(const Arc& arc, double radius, double tolerance, std::vector<Point>& points) {
  const double step = 2 * std::acos(std::clamp(1 - tolerance / radius, 0.0, 1.0));
  const int count = std::max(bounded_count(arc.angle / step), bounded_count(4 * arc.angle / std::acos(-1)));
  for (int i = 1; i < count; ++i) points.push_back(evaluate(Curve(arc), static_cast<double>(i) / count));
}

void add_samples(const CircularArc& arc, double tolerance, std::vector<Point>& points) {
  add_arc_samples(arc, arc.radius, tolerance, points);
}

void add_samples(const EllipticalArc& arc, double tolerance, std::vector<Point>& points) {
  add_arc_samples(arc, arc.major.norm(), tolerance, points);
}

// The distance of a chord over h to its curve is at most h^2 / 8 max |C''|; C'' of a cubic is largest at an
// end of the span.
int chords_of_span(const BSplineCurve& curve, double low, double high, double tolerance) {
  if (curve.degree == 1) return 1;
  const double width = high - low;
  double largest = 0;
  for (const double s : {1e-9, 0.25, 0.5, 0.75, 1 - 1e-9}) {
    largest = std::max(largest, derivatives(curve, low + s * width, 2).row(2).norm());
  }
  return std::max(2, bounded_count(width * std::sqrt(largest / (8 * tolerance))));
}

void add_samples(const BSplineCurve& curve, double tolerance, std::vector<Point>& points) {
  const double end = curve.domain().second;
  for (std::size_t k = static_cast<std::size_t>(curve.degree); k < curve.control_points.size(); ++k) {
    const double low = curve.knots[k], high = curve.knots[k + 1];
    if (low == high) continue;
    const int count = chords_of_span(curve, low, high, tolerance);
    for (int i = 1; i <= count; ++i) {
      const double u = i == count ? high : low + (high - low) * i / count;
      if (u < end) points.push_back(evaluate(curve, u));
    }
  }
}

void extend(Box& box, const LineSegment& line) {
  box.extend(line.start);
  box.extend(line.end);
}
void extend(Box& box, const BSplineCurve& curve) {
  for (const Point& p : curve.control_points) box.extend(p);
}
template <typename Arc>
void extend(Box& box, const Arc& arc) {
  box.extend(arc.start);
  box.extend(arc.end);
  box.extend(Point(2 * arc.center - arc.start));
}

// The normal of a polygon that need not be flat [Newell, in Sutherland et al. 1974].
Vector newell_normal(const std::vector<Point>& points) {
  Vector normal = Vector::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    normal += (points[i] - points[0]).cross(points[(i + 1) % points.size()] - points[0]);
  }
  return normal;
}

// An open zigzag can enclose no area on either side: its widest triangle then.
Vector widest_normal(const std::vector<Point>& points) {
  const auto distance = [&](const Point& p) { return (p - points[0]).squaredNorm(); };
  const Point far = *std::ranges::max_element(points, {}, distance);
  const auto area = [&](const Point& p) { return (far - points[0]).cross(p - points[0]).squaredNorm(); };
  return (far - points[0]).cross(*std::ranges::max_element(points, {}, area) - points[0]);
}

Vector snapped_to_axis(const Vector& direction) {
  for (int axis = 0; axis < 3; ++axis) {
    const Vector unit = Vector::Unit(axis);
    if ((direction - unit).norm() < 1e-9) return unit;
  }
  return direction;
}

}  // namespace

Point start_of(const Curve& curve) {
  return std::visit([](const auto& c) { return first_point(c); }, curve);
}

Point end_of(const Curve& curve) {
  return std::visit([](const auto& c) { return last_point(c); }, curve);
}

std::vector<Point> sampled(const Curve& curve, double tolerance) {
  std::vector<Point> points = {start_of(curve)};
  std::visit([&](const auto& c) { add_samples(c, tolerance, points); }, curve);
  points.push_back(end_of(curve));
  return points;
}

std::vector<Point> chain_points(const Chain& chain, double tolerance) {
  std::vector<Point> points = chain.points;
  for (const Curve& curve : chain.curves) {
    const std::vector<Point> piece = sampled(curve, tolerance);
    points.insert(points.end(), piece.begin() + (points.empty() ? 0 : 1), piece.end());
  }
  if (chain.closed && chain.points.empty()) points.pop_back();
  return points;
}

double chain_size(const Chain& chain) {
  Box box;
  for (const Point& p : chain.points) box.extend(p);
  for (const Curve& curve : chain.curves) {
    std::visit([&](const auto& c) { extend(box, c); }, curve);
  }
  return box.isEmpty() ? 0 : box.diagonal().norm();
}

Vector upward(const Vector& direction) {
  for (const int axis : {2, 1, 0}) {
    if (std::abs(direction[axis]) > 1e-9) return direction[axis] > 0 ? direction : Vector(-direction);
  }
  return direction;
}

std::optional<Plane> plane_of(const std::vector<Point>& points, double tolerance) {
  if (points.empty()) return std::nullopt;
  Vector normal = newell_normal(points);
  const Vector widest = widest_normal(points);
  if (normal.norm() < 1e-6 * widest.norm()) normal = widest;
  if (!(normal.norm() > 0)) {  // on a line: any direction across it
    const Vector along = points.back() - points.front();
    normal = along.norm() > 0 ? along.unitOrthogonal() : Vector::UnitZ();
  }
  const Plane plane{points.front(), snapped_to_axis(upward(normal.normalized()))};
  const bool flat =
      std::ranges::all_of(points, [&](const Point& p) { return plane.distance(p) <= tolerance; });
  return flat ? std::optional(plane) : std::nullopt;
}

}  // namespace meshcontour::detail
