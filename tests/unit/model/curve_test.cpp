#include "meshcontour/curve.hpp"

#include <numbers>
#include <random>

#include "support/catch.hpp"
#include "support/curves.hpp"

using namespace meshcontour;
using namespace meshcontour::test;

namespace {

constexpr double kPi = std::numbers::pi;

Eigen::Matrix3d turned(const Vector& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis.normalized()).matrix();
}

CircularArc make_arc(double radius, double angle) {
  const Eigen::Matrix3d frame = turned({1, 2, 3}, 0.8);
  CircularArc arc;
  arc.center = {3, -2, 5};
  arc.axis = frame.col(2);
  arc.radius = radius;
  arc.angle = angle;
  arc.start = arc.center + radius * frame.col(0);
  arc.end = arc.center + radius * (std::cos(angle) * frame.col(0) + std::sin(angle) * frame.col(1));
  if (arc.full()) arc.end = arc.start;
  return arc;
}

EllipticalArc make_ellipse(double major, double ratio, double begin, double angle) {
  const Eigen::Matrix3d frame = turned({-1, 1, 2}, 1.1);
  EllipticalArc arc;
  arc.center = {-4, 1, 2};
  arc.axis = frame.col(2);
  arc.major = major * frame.col(0);
  arc.ratio = ratio;
  arc.angle = angle;
  const auto at = [&](double t) -> Point {
    return arc.center + major * (std::cos(t) * frame.col(0) + ratio * std::sin(t) * frame.col(1));
  };
  arc.start = at(begin);
  arc.end = arc.full() ? arc.start : at(begin + angle);
  return arc;
}

std::vector<Curve> samples() {
  std::mt19937 engine(5);
  return {LineSegment{{1, 2, 3}, {-4, 0, 9}},
          make_arc(7, 0.3),
          make_arc(7, 4.5),
          make_arc(7, 2 * kPi),
          make_ellipse(20, 0.4, 0.7, 2.5),
          make_ellipse(20, 0.4, 5.0, 2 * kPi),
          random_curve(engine, 3, 9, true, false),
          random_curve(engine, 2, 7, true, true),
          random_curve(engine, 4, 8, false, true),
          random_periodic(engine, 3),
          random_periodic(engine, 11)};
}

// Distance of a point to the circle of an arc.
double off_circle(const Point& p, const CircularArc& arc) {
  const double height = (p - arc.center).dot(arc.axis);
  return std::hypot((p - arc.center - height * arc.axis).norm() - arc.radius, height);
}

}  // namespace

TEST_CASE("evaluate: every curve runs from its start to its end, arcs at their speed", "[curve]") {
  const CircularArc arc = make_arc(7, 4.5);
  CHECK(evaluate(arc, 0) == arc.start);
  CHECK(evaluate(arc, 1) == arc.end);
  for (int k = 0; k <= 10; ++k) {
    const Point p = evaluate(arc, k / 10.0);
    CHECK(off_circle(p, arc) < 1e-14 * 10);
    CHECK(std::abs((p - arc.start).norm() - 2 * 7 * std::abs(std::sin(4.5 * k / 20))) < 1e-13);
  }
  const EllipticalArc ellipse = make_ellipse(20, 0.4, 5.0, 2 * kPi);
  CHECK(ellipse.full());
  CHECK(ellipse.start_parameter() == Approx(5.0).epsilon(1e-14));
  CHECK((evaluate(ellipse, 0.5) - (2 * ellipse.center - ellipse.start)).norm() < 1e-13);
}

TEST_CASE("to_clamped_bspline: a circle is exact, nine points, closed to the last bit", "[curve]") {
  const CircularArc arc = make_arc(7, GENERATE(0.01, 1.5, kPi / 2, kPi, 4.5, 2 * kPi));
  const BSplineCurve curve = to_clamped_bspline(arc);
  CHECK(curve.control_points.front() == arc.start);
  CHECK(curve.control_points.back() == arc.end);
  const auto [begin, end] = curve.domain();
  CHECK(end == std::max(1.0, std::ceil(arc.angle / (kPi / 2) - 1e-9)));
  if (arc.full()) CHECK(curve.control_points.size() == 9);
  for (int k = 0; k <= 1000; ++k) {  // of numbers up to 12, whose rounding is 1.8e-15
    CHECK(off_circle(evaluate(curve, begin + (end - begin) * k / 1000), arc) < 1e-14);
  }
}

TEST_CASE("to_clamped_bspline: an ellipse is exact", "[curve]") {
  const EllipticalArc arc =
      make_ellipse(20, GENERATE(0.4, 1e-3, 1.0), GENERATE(0.0, 2.9), GENERATE(0.7, 3.0, 2 * kPi));
  const BSplineCurve curve = to_clamped_bspline(arc);
  const auto [begin, end] = curve.domain();
  for (int k = 0; k <= 300; ++k) {
    const Vector p = evaluate(curve, begin + (end - begin) * k / 300) - arc.center;
    const double x = p.dot(arc.major) / arc.major.squaredNorm();
    const double y = p.dot(arc.minor()) / arc.minor().squaredNorm();
    CHECK(std::hypot(x, y) == Approx(1).epsilon(arc.ratio < 0.1 ? 1e-11 : 1e-14));
    CHECK(std::abs(p.dot(arc.axis)) < 1e-14 * 20);
  }
}

TEST_CASE("to_clamped_bspline: clamping moves no point and starts at the end points", "[curve]") {
  for (const Curve& curve : samples()) {
    const BSplineCurve clamped = to_clamped_bspline(curve);
    CHECK((clamped.control_points.front() - evaluate(clamped, clamped.domain().first)).norm() < 1e-14);
    CHECK((clamped.control_points.front() - evaluate(curve, 0)).norm() < 1e-13);
    CHECK((clamped.control_points.back() - evaluate(curve, 1)).norm() < 1e-13);
    CHECK(clamped.knots.size() ==
          clamped.control_points.size() + static_cast<std::size_t>(clamped.degree) + 1);
    if (!std::holds_alternative<BSplineCurve>(curve)) continue;
    const auto& original = std::get<BSplineCurve>(curve);
    CHECK(clamped.domain() == original.domain());
    for (int k = 0; k <= 100; ++k) {
      CHECK((evaluate(clamped, original.domain().first +
                                   k / 100.0 * (original.domain().second - original.domain().first)) -
             evaluate(curve, k / 100.0))
                .norm() < 1e-12);
    }
  }
}

TEST_CASE("to_clamped_bspline: a periodic curve changes at its ends only", "[curve]") {
  std::mt19937 engine(6);
  const BSplineCurve periodic = random_periodic(engine, 12);
  const BSplineCurve clamped = to_clamped_bspline(periodic);
  REQUIRE(clamped.control_points.size() == periodic.control_points.size());
  for (std::size_t i = 3; i + 3 < clamped.control_points.size(); ++i) {
    CHECK(clamped.control_points[i] == periodic.control_points[i]);
  }
  CHECK(clamped.control_points.front() == clamped.control_points.back());
  CHECK_FALSE(clamped.periodic);
}

TEST_CASE("reversed: the same points backwards, and twice is as before", "[curve]") {
  for (const Curve& curve : samples()) {
    const Curve back = reversed(curve), again = reversed(back);
    for (int k = 0; k <= 64; ++k) {
      CHECK((evaluate(back, k / 64.0) - evaluate(curve, 1 - k / 64.0)).norm() < 2e-13);
      CHECK((evaluate(again, k / 64.0) - evaluate(curve, k / 64.0)).norm() < 2e-13);
    }
    if (std::holds_alternative<BSplineCurve>(curve)) {
      CHECK(std::get<BSplineCurve>(back).domain() == std::get<BSplineCurve>(curve).domain());
    } else {
      CHECK(evaluate(back, 0) == evaluate(curve, 1));
    }
  }
}

TEST_CASE("transformed: a similarity keeps the kind, any affine map the points", "[curve][property]") {
  Eigen::Affine3d placement = Eigen::Affine3d::Identity();
  const int kind = GENERATE(0, 1, 2, 3);
  placement.linear() = 2.5 * turned({3, -1, 1}, 2.0);
  if (kind == 1) placement.linear().col(1) *= -1;
  if (kind == 2) placement.linear() *= Eigen::Vector3d(1, 0.3, -2).asDiagonal();
  if (kind == 3) placement.linear() << 1, 0.7, 0, 0, 1.5, 0.2, 0.4, 0, 0.5;
  placement.translation() = Vector(10, -20, 30);
  for (const Curve& curve : samples()) {
    const Curve moved = transformed(curve, placement);
    if (kind < 2) CHECK(moved.index() == curve.index());
    if (std::holds_alternative<CircularArc>(curve) && kind >= 2)
      CHECK(std::holds_alternative<EllipticalArc>(moved));
    const double margin = 1e-12 * 100;
    if (curve.index() < 3) CHECK(evaluate(moved, 0) == placement * evaluate(curve, 0));
    for (int k = 0; k <= 50; ++k) {
      CHECK((evaluate(moved, k / 50.0) - placement * evaluate(curve, k / 50.0)).norm() < margin);
    }
  }
}

TEST_CASE("transformed: an image keeps the promises of its type", "[curve]") {
  Eigen::Affine3d squash(Eigen::Scaling(1.0, 0.2, -3.0));
  const auto check = [](const EllipticalArc& e) {
    CHECK(e.axis.norm() == Approx(1).epsilon(1e-14));
    CHECK(std::abs(e.axis.dot(e.major)) < 1e-13 * e.major.norm());
    CHECK(e.ratio > 0);
    CHECK(e.ratio <= 1);
  };
  check(std::get<EllipticalArc>(transformed(make_arc(7, 4.5), squash)));
  check(std::get<EllipticalArc>(transformed(make_ellipse(20, 0.4, 1, 2), squash)));
  Eigen::Affine3d mirror(Eigen::Scaling(1.0, 1.0, -1.0));
  const auto arc = std::get<CircularArc>(transformed(make_arc(7, 4.5), mirror));
  CHECK(arc.axis.norm() == Approx(1).epsilon(1e-14));
  CHECK(arc.radius == Approx(7).epsilon(1e-15));
}

TEST_CASE("transformed: a map that flattens an arc gives the same points as a spline", "[curve]") {
  Eigen::Affine3d flat = Eigen::Affine3d::Identity();
  flat.linear() = Vector(1, 1, 1) * Vector(0.2, -0.3, 1).transpose();
  const CircularArc arc = make_arc(7, 4.5);
  const Curve moved = transformed(arc, flat);
  REQUIRE(std::holds_alternative<BSplineCurve>(moved));
  CHECK((evaluate(moved, 1) - flat * arc.end).norm() < 1e-13);
}

TEST_CASE("length: the closed forms", "[curve]") {
  CHECK(length(LineSegment{{0, 0, 0}, {3, 4, 12}}) == 13);
  CHECK(length(make_arc(7, 4.5)) == Approx(31.5).epsilon(1e-15));
  CHECK(length(to_clamped_bspline(make_arc(7, 4.5))) == Approx(31.5).epsilon(1e-11));
  // Perimeter 4 a E(e), by the series of [Ivory 1796] in ((a-b)/(a+b))^2.
  const double a = 20, b = 8, h = std::pow((a - b) / (a + b), 2);
  double sum = 0, coefficient = 1;
  for (int n = 0; n < 60; ++n) {
    sum += coefficient * coefficient * std::pow(h, n);
    coefficient *= (0.5 - n) / (n + 1);
  }
  const EllipticalArc ellipse = make_ellipse(a, b / a, 0.7, 2 * kPi);
  CHECK(length(ellipse) == Approx(kPi * (a + b) * sum).epsilon(1e-10));
  CHECK(length(to_clamped_bspline(ellipse)) == Approx(kPi * (a + b) * sum).epsilon(1e-10));
  CHECK(length(make_ellipse(20, 1e-9, 0.7, 2 * kPi)) == Approx(80).epsilon(1e-9));
  // y = x^2 from 0 to 1 as a cubic: (2 sqrt 5 + asinh 2) / 4.
  const BSplineCurve parabola{
      3, {0, 0, 0, 0, 1, 1, 1, 1}, {{0, 0, 0}, {1. / 3, 0, 0}, {2. / 3, 1. / 3, 0}, {1, 1, 0}}, {}, false};
  CHECK(length(parabola) == Approx((2 * std::sqrt(5.0) + std::asinh(2.0)) / 4).epsilon(1e-12));
  // A cusp: x = t^2, y = t^3 for t in [-1, 1].
  const BSplineCurve cusp{
      3, {-1, -1, -1, -1, 1, 1, 1, 1}, {{1, -1, 0}, {-1. / 3, 1, 0}, {-1. / 3, -1, 0}, {1, 1, 0}}, {}, false};
  CHECK(length(cusp) == Approx(2 * (std::pow(13.0, 1.5) - 8) / 27).epsilon(1e-10));
}

TEST_CASE("length: a point has none", "[curve]") {
  const BSplineCurve point{3, {0, 0, 0, 0, 1, 1, 1, 1}, std::vector<Point>(4, Point(1, 2, 3)), {}, false};
  CHECK(length(point) < 1e-14);
}
