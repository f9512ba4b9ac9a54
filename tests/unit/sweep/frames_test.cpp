#include <cmath>
#include <numbers>
#include <random>

#include "read/swp.hpp"
#include "support/catch.hpp"
#include "support/curves.hpp"
#include "survey.hpp"

using namespace sweeps;

namespace {

constexpr double kPi = std::numbers::pi;

SweepCurve knot(std::uint64_t steps) {
  SweepCurve curve = detail::parse_swp(data_bytes("knot23.swp"), "knot23.swp").curves.at(1);
  curve.steps = steps;
  return curve;
}

SweepCurve spline(SweepCurve::Kind kind, std::vector<Point> points, std::uint64_t steps,
                  bool planar = false) {
  SweepCurve curve;
  curve.kind = kind;
  curve.planar = planar;
  curve.steps = steps;
  curve.control_points = std::move(points);
  return curve;
}

SweepCurve random_closed_curve(std::mt19937& engine, std::size_t distinct, std::uint64_t steps) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < distinct; ++i) points.push_back(test::random_point(engine, 3));
  for (std::size_t i = 0; i < 3; ++i) points.push_back(points[i]);
  return spline(SweepCurve::Kind::BSpline, points, steps);
}

FramedCurve framed(const SweepCurve& curve, FrameMethod method = FrameMethod::RotationMinimizing) {
  SweepOptions options;
  options.frames = method;
  return frame_curve(curve, options);
}

double orthonormality_error(const CurveFrame& frame) {
  Eigen::Matrix3d axes;
  axes << frame.normal, frame.binormal, frame.tangent;
  const double error = (axes.transpose() * axes - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  return std::max(error, std::abs(axes.determinant() - 1));
}

double largest_error(const FramedCurve& curve) {
  double largest = 0;
  for (const CurveFrame& frame : curve.frames) largest = std::max(largest, orthonormality_error(frame));
  return largest;
}

double seam_error(const FramedCurve& curve) {
  const CurveFrame &first = curve.frames.front(), &last = curve.frames.back();
  return std::max((first.normal - last.normal).norm(), (first.binormal - last.binormal).norm());
}

// Angles modulo a whole turn.
double angle_error(double a, double b) {
  return std::abs(std::remainder(a - b, 2 * kPi));
}

std::size_t flips(const FramedCurve& curve) {
  std::size_t count = 0;
  for (std::size_t i = 1; i < curve.frames.size(); ++i) {
    count += curve.frames[i].normal.dot(curve.frames[i - 1].normal) < 0 ? 1 : 0;
  }
  return count;
}

}  // namespace

TEST_CASE("frame_curve: frames are orthonormal and right-handed, and run with the curve", "[sweep][frames]") {
  const FrameMethod method =
      GENERATE(FrameMethod::RotationMinimizing, FrameMethod::Projection, FrameMethod::Frenet);
  std::mt19937 engine(5);
  for (int i = 0; i < 20; ++i) {
    const FramedCurve curve = framed(random_closed_curve(engine, 7, 40), method);
    CHECK(largest_error(curve) < 1e-12);
    for (std::size_t k = 1; k < curve.frames.size(); ++k) {
      const Vector chord = curve.frames[k].position - curve.frames[k - 1].position;
      REQUIRE(curve.frames[k - 1].tangent.dot(chord) > 0);
    }
  }
}

TEST_CASE("frame_curve: on a smooth closed curve the last frame is the first", "[sweep][frames]") {
  const FrameMethod method = GENERATE(FrameMethod::RotationMinimizing, FrameMethod::Projection);
  std::mt19937 engine(6);
  double largest_angle = 0;
  for (int i = 0; i < 20; ++i) {
    const FramedCurve curve = framed(random_closed_curve(engine, 6, 12), method);
    REQUIRE(curve.smooth);
    largest_angle = std::max(largest_angle, std::abs(curve.closing_angle));
    CHECK(seam_error(curve) < 1e-12);
  }
  CHECK(largest_angle > 1);  // there is something to spread
}

TEST_CASE("frame_curve: the closing angle is of order 4 by double reflection, of less than 2 by projection",
          "[sweep][frames]") {
  const double limit = framed(knot(256)).closing_angle;
  double reflection = 0, projection = 0;
  for (const std::uint64_t steps : {2, 4, 8, 16, 32}) {
    const double finer_reflection = angle_error(framed(knot(steps)).closing_angle, limit);
    const double finer_projection =
        angle_error(framed(knot(steps), FrameMethod::Projection).closing_angle, limit);
    INFO(steps << " steps: " << finer_reflection * 180 / kPi << " and " << finer_projection * 180 / kPi);
    if (steps > 2) {
      CHECK(std::log2(reflection / finer_reflection) == Approx(4).margin(0.2));
      CHECK(std::log2(projection / finer_projection) < 2.01);
    }
    reflection = finer_reflection;
    projection = finer_projection;
  }
  CHECK(limit * 180 / kPi == Approx(169.7249).margin(1e-4));
}

TEST_CASE("frame_curve: the closing angle is spread by arc length", "[sweep][frames]") {
  // What is left of the twist between neighbours, once the carried frame is subtracted, is theta ds / L.
  const FramedCurve curve = framed(knot(64));
  const double rate = curve.closing_angle / curve.length;
  for (std::size_t i = 1; i < curve.frames.size(); ++i) {
    const CurveFrame &a = curve.frames[i - 1], &b = curve.frames[i];
    const Vector axis = a.tangent.cross(b.tangent);
    const double angle = std::atan2(axis.norm(), a.tangent.dot(b.tangent));
    const Vector carried = Eigen::AngleAxisd(angle, axis.normalized()) * a.normal;
    const double twist = std::atan2(b.tangent.dot(carried.cross(b.normal)), carried.dot(b.normal));
    const double step = (b.position - a.position).norm();
    REQUIRE(std::abs(twist - rate * step) < 2e-5);
  }
}

TEST_CASE("frame_curve: a curve that starts along z, up or down, has a normal", "[sweep][frames]") {
  const double sign = GENERATE(1.0, -1.0);
  const SweepCurve curve =
      spline(SweepCurve::Kind::Bezier, {{0, 0, 0}, {0, 0, sign}, {1, 0, 2 * sign}, {2, 1, 2 * sign}}, 16);
  const FramedCurve frames = framed(curve);
  CHECK(frames.frames[0].normal == Vector(sign, 0, 0));
  CHECK(frames.frames[0].binormal == Vector(0, 1, 0));
  CHECK(largest_error(frames) < 1e-12);
}

TEST_CASE("frame_curve: normals flip at inflections for Frenet only", "[sweep][frames]") {
  const SweepCurve wave =
      spline(SweepCurve::Kind::BSpline, {{0, 0, 0}, {1, 2, 0}, {2, -2, 0}, {3, 2, 0}, {4, -2, 0}, {5, 0, 0}},
             17, true);
  CHECK(flips(framed(wave)) == 0);
  CHECK(flips(framed(wave, FrameMethod::Projection)) == 0);
  CHECK(flips(framed(wave, FrameMethod::Frenet)) == 3);
}

TEST_CASE("frame_curve: plane curves have their normal on the left and z as binormal", "[sweep][frames]") {
  const SweepCurve arch =
      spline(SweepCurve::Kind::Bezier, {{-4, 0, 0}, {-4, 3, 0}, {-1, 3, 0}, {-1, 0, 0}}, 16, true);
  for (const CurveFrame& frame : framed(arch).frames) {
    CHECK(frame.binormal == Vector(0, 0, 1));
    CHECK(frame.normal == Vector(-frame.tangent.y(), frame.tangent.x(), 0));
  }
}

TEST_CASE("frame_curve: where the derivative vanishes the tangent is its limit", "[sweep][frames]") {
  SECTION("at both ends") {
    const FramedCurve curve =
        framed(spline(SweepCurve::Kind::Bezier, {{0, 0, 0}, {0, 0, 0}, {1, 1, 0}, {1, 1, 0}}, 4));
    for (const CurveFrame& frame : curve.frames) {
      CHECK((frame.tangent - Vector(1, 1, 0).normalized()).norm() < 1e-12);
    }
  }
  SECTION("of second order") {
    const FramedCurve curve =
        framed(spline(SweepCurve::Kind::Bezier, {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 2, 1}}, 4));
    CHECK((curve.frames[0].tangent - Vector(0, 2, 1).normalized()).norm() < 1e-12);
  }
  SECTION("a piece that is one point takes the tangent before") {
    const Point p(3, 0, 1);
    const FramedCurve curve =
        framed(spline(SweepCurve::Kind::Bezier,
                      {{0, 0, 1}, {1, 0, 1}, {2, 0, 1}, p, p, p, p, {4, 0, 1}, {5, 1, 1}, {6, 2, 1}}, 5));
    CHECK(curve.frames.size() == 16);
    CHECK((curve.frames[8].tangent - Vector::UnitX()).norm() < 1e-12);
    CHECK(largest_error(curve) < 1e-12);
  }
  SECTION("a curve that is one point has no frames") {
    const Point p(3, 0, 1);
    CHECK(framed(spline(SweepCurve::Kind::Bezier, {p, p, p, p}, 5)).frames.empty());
  }
}

TEST_CASE("frame_curve: a circle of radius 0 keeps its directions", "[sweep][frames]") {
  SweepCurve circle;
  circle.kind = SweepCurve::Kind::Circle;
  circle.steps = 4;
  const FramedCurve curve = framed(circle);
  CHECK(curve.frames.size() == 5);
  CHECK(curve.frames[1].tangent == Vector(-1, 0, 0));
  CHECK(curve.frames[1].normal == Vector(0, -1, 0));
}

TEST_CASE("to_curve: passes through the samples", "[sweep]") {
  std::mt19937 engine(7);
  for (const SweepCurve::Kind kind : {SweepCurve::Kind::Bezier, SweepCurve::Kind::BSpline}) {
    std::vector<Point> points;
    for (std::size_t i = 0; i < 10; ++i) points.push_back(test::random_point(engine));
    const SweepCurve curve = spline(kind, points, 8);
    const auto exact = std::get<BSplineCurve>(to_curve(curve));
    const auto [begin, end] = exact.domain();
    const FramedCurve samples = framed(curve);
    for (std::size_t i = 0; i < samples.frames.size(); ++i) {
      const double u =
          begin + (end - begin) * static_cast<double>(i) / static_cast<double>(samples.frames.size() - 1);
      REQUIRE((test::position_by_definition(exact, u) - samples.frames[i].position).norm() < 1e-13);
    }
  }
}

TEST_CASE("to_curve: a B-spline that repeats its first three points is periodic", "[sweep]") {
  std::mt19937 engine(8);
  SweepCurve curve = random_closed_curve(engine, 5, 3);
  CHECK(std::get<BSplineCurve>(to_curve(curve)).periodic);
  curve.control_points.back() += Vector(1e-12, 0, 0);
  CHECK_FALSE(std::get<BSplineCurve>(to_curve(curve)).periodic);
  CHECK(framed(curve).smooth);
}
