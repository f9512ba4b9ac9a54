#include "fit/ellipse_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "fit/arc_fit.hpp"

namespace meshcontour::detail {

namespace {

using Flat = Eigen::Vector2d;
constexpr double kTwoPi = 2 * std::numbers::pi;
constexpr double kFlattest = 200;      // largest ratio of the half axes
constexpr std::size_t kSamples = 256;  // fitted points of a long run

// An ellipse in its plane: centre, half axes, and the direction of the first one.
struct FlatEllipse {
  Flat centre = Flat::Zero();
  double a = 0, b = 0, turn = 0;

  Flat to_local(const Flat& p) const {
    const Flat v = p - centre;
    const double c = std::cos(turn), s = std::sin(turn);
    return {c * v.x() + s * v.y(), c * v.y() - s * v.x()};
  }
};

// Parameter of the point of an axis-parallel ellipse nearest to p: Newton on the foot of the normal.
double foot(double a, double b, const Flat& p) {
  double t = std::atan2(p.y() / b, p.x() / a);
  for (int step = 0; step < 12; ++step) {
    const double c = std::cos(t), s = std::sin(t);
    const Flat gap(p.x() - a * c, p.y() - b * s);
    const double slope = -gap.x() * a * s + gap.y() * b * c;
    const double bend = gap.x() * a * c + gap.y() * b * s + a * a * s * s + b * b * c * c;
    if (!(bend > 0)) break;
    const double change = slope / bend;
    t += change;
    if (!(std::abs(change) > 1e-15)) break;
  }
  return t;
}

// Conic through the points in least squares under 4ac - b^2 = 1, as (A, B, C, D, E, F). [Halir & Flusser
// 1998]
bool direct_conic(const std::vector<Flat>& points, Eigen::Matrix<double, 6, 1>& conic) {
  Eigen::Matrix3d s1 = Eigen::Matrix3d::Zero(), s2 = s1, s3 = s1;
  for (const Flat& p : points) {
    const Eigen::Vector3d square(p.x() * p.x(), p.x() * p.y(), p.y() * p.y()), linear(p.x(), p.y(), 1);
    s1 += square * square.transpose();
    s2 += square * linear.transpose();
    s3 += linear * linear.transpose();
  }
  const Eigen::Matrix3d t = -s3.ldlt().solve(s2.transpose());
  const Eigen::Matrix3d m = s1 + s2 * t;
  Eigen::Matrix3d reduced;
  reduced << m.row(2) / 2, -m.row(1), m.row(0) / 2;
  if (!reduced.allFinite()) return false;
  const Eigen::EigenSolver<Eigen::Matrix3d> solver(reduced);
  for (int i = 0; i < 3; ++i) {
    if (solver.eigenvalues()(i).imag() != 0) continue;
    const Eigen::Vector3d square = solver.eigenvectors().col(i).real();
    if (!(4 * square(0) * square(2) - square(1) * square(1) > 0)) continue;
    conic << square, t * square;
    return conic.allFinite();
  }
  return false;
}

bool to_ellipse(const Eigen::Matrix<double, 6, 1>& conic, FlatEllipse& ellipse) {
  Eigen::Matrix2d form;
  form << conic(0), conic(1) / 2, conic(1) / 2, conic(2);
  const Flat linear(conic(3), conic(4));
  if (!(form.determinant() > 0)) return false;
  ellipse.centre = -form.inverse() * linear / 2;
  const double level = -(conic(5) + linear.dot(ellipse.centre) / 2);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(form);
  const double first = level / axes.eigenvalues()(0), second = level / axes.eigenvalues()(1);
  if (!(first > 0 && second > 0)) return false;
  const bool swap = first < second;
  ellipse.a = std::sqrt(swap ? second : first);
  ellipse.b = std::sqrt(swap ? first : second);
  const Flat direction = axes.eigenvectors().col(swap ? 1 : 0);
  ellipse.turn = std::atan2(direction.y(), direction.x());
  return std::isfinite(ellipse.a) && std::isfinite(ellipse.turn);
}

// One step of Gauss-Newton on the distances of the points to the ellipse. False: nothing more to gain.
bool improve(const std::vector<Flat>& points, FlatEllipse& ellipse) {
  Eigen::Matrix<double, 5, 5> normal = Eigen::Matrix<double, 5, 5>::Zero();
  Eigen::Matrix<double, 5, 1> right = Eigen::Matrix<double, 5, 1>::Zero();
  const double a = ellipse.a, b = ellipse.b, c = std::cos(ellipse.turn), s = std::sin(ellipse.turn);
  for (const Flat& p : points) {
    const Flat local = ellipse.to_local(p);
    const double t = foot(a, b, local);
    const double x = a * std::cos(t), y = b * std::sin(t);
    const Flat outward = Flat(std::cos(t) / a, std::sin(t) / b).normalized();
    const double distance = (local - Flat(x, y)).dot(outward);
    const Flat turned(c * outward.x() - s * outward.y(), s * outward.x() + c * outward.y());
    Eigen::Matrix<double, 5, 1> row;
    row << -turned, -std::cos(t) * outward.x(), -std::sin(t) * outward.y(),
        -(x * outward.y() - y * outward.x());
    normal += row * row.transpose();
    right -= distance * row;
  }
  const Eigen::Matrix<double, 5, 1> change = normal.ldlt().solve(right);
  if (!change.allFinite()) return false;
  ellipse.centre += change.head<2>();
  ellipse.a += change(2);
  ellipse.b += change(3);
  ellipse.turn += change(4);
  return change.head<4>().norm() > 1e-15 * ellipse.a && ellipse.a > 0 && ellipse.b > 0;
}

// The plane of least squares of the points, right-handed with their turn.
struct Plane {
  Point origin = Point::Zero();
  Vector x = Vector::UnitX(), y = Vector::UnitY(), normal = Vector::UnitZ();
  Flat flat(const Point& p) const { return {(p - origin).dot(x), (p - origin).dot(y)}; }
  Point space(const Flat& p) const { return origin + p.x() * x + p.y() * y; }
};

Plane least_squares_plane(std::span<const Point> points) {
  Plane plane;
  for (const Point& p : points) plane.origin += p;
  plane.origin /= static_cast<double>(points.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  Vector area = Vector::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector v = points[i] - plane.origin, next = points[(i + 1) % points.size()] - plane.origin;
    covariance += v * v.transpose();
    area += v.cross(next);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> frame(covariance);
  plane.normal = frame.eigenvectors().col(0).normalized();
  if (plane.normal.dot(area) < 0) plane.normal = -plane.normal;
  plane.x = frame.eigenvectors().col(2).normalized();
  plane.y = plane.normal.cross(plane.x);
  return plane;
}

EllipticalArc in_space(const FlatEllipse& ellipse, const Plane& plane) {
  EllipticalArc arc;
  const bool swap = ellipse.a < ellipse.b;
  const double turn = ellipse.turn + (swap ? std::numbers::pi / 2 : 0);
  const double a = swap ? ellipse.b : ellipse.a, b = swap ? ellipse.a : ellipse.b;
  arc.center = plane.space(ellipse.centre);
  arc.axis = plane.normal;
  arc.major = a * (std::cos(turn) * plane.x + std::sin(turn) * plane.y);
  arc.ratio = std::min(b / a, 1.0);
  return arc;
}

Point at(const EllipticalArc& arc, double t) {
  return arc.center + std::cos(t) * arc.major + std::sin(t) * arc.ratio * arc.axis.cross(arc.major);
}

// The turn of the points about the centre in the ellipse's parameter; negative when a step is backwards or
// too wide.
double checked_sweep(const EllipticalArc& arc, std::span<const Point> points, bool closed) {
  double sweep = 0, before = ellipse_parameter(arc, points[0]);
  const std::size_t steps = closed ? points.size() : points.size() - 1;
  for (std::size_t i = 0; i < steps; ++i) {
    const double here = ellipse_parameter(arc, points[(i + 1) % points.size()]);
    double step = here - before;
    if (step < 0) step += kTwoPi;
    if (!(step > 0 && step <= kLargestStep)) return -1;
    sweep += step;
    before = here;
  }
  return sweep;
}

std::optional<FlatEllipse> fit_flat(std::span<const Point> points, const Plane& plane) {
  const std::size_t samples = std::min(points.size(), kSamples);
  std::vector<Flat> flat(samples);
  double scale = 0;
  for (std::size_t s = 0; s < samples; ++s) {
    flat[s] = plane.flat(points[s * points.size() / samples]);
    scale = std::max(scale, flat[s].norm());
  }
  if (!(scale > 0)) return std::nullopt;
  for (Flat& p : flat) p /= scale;
  Eigen::Matrix<double, 6, 1> conic;
  FlatEllipse ellipse;
  if (!direct_conic(flat, conic) || !to_ellipse(conic, ellipse)) return std::nullopt;
  if (!(ellipse.a <= kFlattest * ellipse.b)) return std::nullopt;
  for (int step = 0; step < 6 && improve(flat, ellipse); ++step) {
  }
  ellipse.centre *= scale;
  ellipse.a *= scale;
  ellipse.b *= scale;
  const double longest = std::max(ellipse.a, ellipse.b), shortest = std::min(ellipse.a, ellipse.b);
  if (!(shortest > 0 && longest <= kFlattest * shortest && longest <= 1e3 * scale)) return std::nullopt;
  return ellipse;
}

}  // namespace

double ellipse_parameter(const EllipticalArc& arc, const Point& point) {
  const double a = arc.major.norm(), b = a * arc.ratio;
  const Vector x = arc.major / a, y = arc.axis.cross(x), v = point - arc.center;
  const double t = foot(a, b, {v.dot(x), v.dot(y)});
  return std::atan2(std::sin(t), std::cos(t));
}

double distance_to_ellipse(const EllipticalArc& arc, const Point& point) {
  return (point - at(arc, ellipse_parameter(arc, point))).norm();
}

void hold_ends(EllipticalArc& arc) {
  const Point from = at(arc, ellipse_parameter(arc, arc.start)),
              to = at(arc, ellipse_parameter(arc, arc.end));
  const Vector before = to - from, after = arc.end - arc.start;
  if (!(before.norm() > 0 && after.norm() > 0)) return;
  const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(before, after);
  const double scale = after.norm() / before.norm();
  arc.center = arc.start + scale * (turn * (arc.center - from));
  arc.axis = (turn * arc.axis).normalized();
  arc.major = scale * (turn * arc.major);
}

std::optional<EllipseFit> fit_ellipse(std::span<const Point> points, bool closed, double limit) {
  const Plane plane = least_squares_plane(points);
  for (const Point& p : points) {
    if (!(std::abs((p - plane.origin).dot(plane.normal)) <= limit)) return std::nullopt;
  }
  const std::optional<FlatEllipse> flat = fit_flat(points, plane);
  if (!flat) return std::nullopt;
  EllipseFit fit;
  EllipticalArc& arc = fit.arc;
  arc = in_space(*flat, plane);
  arc.start = points.front();
  arc.end = points.back();
  if (!closed) hold_ends(arc);
  for (auto p = points.rbegin(); p != points.rend(); ++p) {
    const double distance = distance_to_ellipse(arc, *p);
    if (!(distance <= limit)) return std::nullopt;
    fit.residual = std::max(fit.residual, distance);
  }
  arc.angle = checked_sweep(arc, points, closed);
  if (!(arc.angle > 0 && arc.angle < kTwoPi + 1e-6)) return std::nullopt;
  arc.angle = std::min(arc.angle, kTwoPi);
  if (!closed && arc.full() && arc.start != arc.end) return std::nullopt;
  if (closed) {
    if (!(std::abs(arc.angle - kTwoPi) < 1e-6)) return std::nullopt;
    arc.angle = kTwoPi;
    arc.start = at(arc, ellipse_parameter(arc, points[0]));
    arc.end = arc.start;
  }
  return fit;
}

double ellipse_deviation(const EllipticalArc& arc, std::span<const Point> points, double residual) {
  // The arc's point farthest from a chord lies at the middle parameter, where the tangent is parallel to it:
  // there the arc is (1 - cos(half step)) of its distance from the centre away from the chord's middle.
  const Vector minor = arc.ratio * arc.axis.cross(arc.major);
  double worst = 0;
  const std::size_t chords = arc.full() ? points.size() : points.size() - 1;
  for (std::size_t i = 0; i < chords; ++i) {
    const double from = ellipse_parameter(arc, points[i]);
    double step = ellipse_parameter(arc, points[(i + 1) % points.size()]) - from;
    if (step < 0) step += kTwoPi;
    const double middle = from + step / 2;
    const Vector spoke = std::cos(middle) * arc.major + std::sin(middle) * minor;
    worst = std::max(worst, (1 - std::cos(step / 2)) * spoke.norm());
  }
  return worst + residual + 1e-14 * (arc.major.norm() + arc.center.norm());
}

}  // namespace meshcontour::detail
