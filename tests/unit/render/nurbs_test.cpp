// What gluNurbsCurve makes of our curves, against our own evaluation. GLU works in tessellator mode: no
// context needed.

#include <cmath>
#include <numbers>

#include "meshcontour/fit.hpp"
#include "render/bezier.hpp"
#include "render/camera.hpp"
#include "render/gl_module.hpp"
#include "support/catch.hpp"

using namespace meshcontour;
using namespace meshcontour::detail;

namespace {

using Strips = std::vector<NurbsStrip>;

const GlApi& api() {
  std::string failure;
  for (const GlBackend backend : backends(GlBackend::Automatic)) {
    if (const GlApi* found = load_gl_module(backend, failure)) return *found;
  }
  throw std::runtime_error(failure);
}

// The report's stretched and bent loop of n vertices: nothing about it is flat, round or regular.
std::vector<Point> loop(std::size_t n, const Point& center) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < n; ++i) {
    const double t = 2 * std::numbers::pi * double(i) / double(n);
    points.push_back(center +
                     Point((3 + std::cos(5 * t)) * std::cos(t), 2 * std::sin(t), 0.5 * std::sin(3 * t)));
  }
  return points;
}

std::vector<float> floats(const std::vector<Point>& points, const LocalFrame& frame) {
  std::vector<float> result;
  for (const Point& p : points) {
    const Eigen::Vector3f local = frame.local(p);
    result.insert(result.end(), local.data(), local.data() + 3);
  }
  return result;
}

LocalFrame frame_of(const std::vector<Point>& points) {
  Box box;
  for (const Point& p : points) box.extend(p);
  return local_frame(box);
}

Point in_model(const std::array<float, 3>& v, const LocalFrame& frame) {
  return frame.center + frame.size * Point(v[0], v[1], v[2]);
}

// The largest distance of a strip's vertices, evenly spaced over [begin, end], to the curve; in sizes of the
// frame.
double distance(const NurbsStrip& strip, const BSplineCurve& curve, double begin, double end,
                const LocalFrame& frame) {
  double largest = 0;
  for (std::size_t j = 0; j < strip.size(); ++j) {
    const double u = begin + (end - begin) * double(j) / double(strip.size() - 1);
    largest = std::max(largest, (in_model(strip[j], frame) - evaluate(curve, u)).norm() / frame.size);
  }
  return largest;
}

Strips tessellate(const NurbsCurve& curve) {
  Strips strips;
  const GlOutcome outcome = api().tessellate(curve, strips);
  if (outcome.status != GlOutcome::Status::Done) throw std::runtime_error(outcome.message);
  return strips;
}

// The curve as the layers draw it: Bezier pieces about the frame's centre, in runs.
Strips tessellate_as_drawn(const BSplineCurve& curve, const LocalFrame& frame, std::size_t run) {
  const BezierCurve bezier = to_bezier(curve, frame.center, frame.size);
  Strips strips;
  for (std::size_t first = 0; first < bezier.pieces(); first += run) {
    const std::size_t pieces = std::min(run, bezier.pieces() - first);
    const auto knots = bezier_knots(pieces, bezier.degree);
    const auto control = packed_control(bezier, first, pieces);
    const Strips part = tessellate({bezier.degree + 1, bezier.rational, knots, control, 7.5F});
    strips.insert(strips.end(), part.begin(), part.end());
  }
  return strips;
}

}  // namespace

TEST_CASE("gluNurbsCurve: its vertices lie on our own curve, for any loop anywhere", "[render][nurbs]") {
  const std::size_t n = GENERATE(3, 4, 5, 34, 1000, 100'000);
  const double offset = GENERATE(0.0, 1e6);
  const auto points = loop(n, Point(offset, -offset, 2 * offset));
  const BSplineCurve curve = control_polygon_curve(points);
  const LocalFrame frame = frame_of(points);
  const Strips strips = tessellate_as_drawn(curve, frame, 100);
  REQUIRE(strips.size() == n);
  double largest = 0;
  for (std::size_t i = 0; i < n; ++i) {
    REQUIRE(strips[i].size() == 9);
    const double begin = curve.knots[std::size_t(curve.degree) + i];
    const double end = curve.knots[std::size_t(curve.degree) + i + 1];
    largest = std::max(largest, distance(strips[i], curve, begin, end, frame));
  }
  CHECK(largest < 1e-5);
}

TEST_CASE("gluNurbsCurve: consecutive strips meet, and the last meets the first", "[render][nurbs]") {
  const auto points = loop(250, Point::Zero());
  const Strips strips = tessellate_as_drawn(control_polygon_curve(points), frame_of(points), 100);
  for (std::size_t i = 0; i < strips.size(); ++i) {
    const auto& here = strips[i].back();
    const auto& next = strips[(i + 1) % strips.size()].front();
    for (std::size_t c = 0; c < 3; ++c) CHECK(here[c] == Approx(next[c]).margin(1e-6));
  }
}

TEST_CASE("gluNurbsCurve: normalised knots, integer knots and own blending give one curve",
          "[render][nurbs]") {
  const std::size_t n = GENERATE(3, 7, 34, 500);
  const auto points = loop(n, Point::Zero());
  BSplineCurve own = control_polygon_curve(points);
  const LocalFrame frame = frame_of(points);
  const auto control = floats(own.control_points, frame);
  std::vector<float> integer, normalised;
  for (std::size_t i = 0; i < own.knots.size(); ++i) {
    integer.push_back(float(i));
    normalised.push_back(float(i) / float(own.knots.size() - 1));
    own.knots[i] = double(i);
  }
  const Strips by_integers = tessellate({4, false, integer, control, 4.5F});
  const Strips by_fractions = tessellate({4, false, normalised, control, 4.5F * float(own.knots.size() - 1)});
  REQUIRE(by_integers.size() == n);
  REQUIRE(by_fractions.size() == n);
  for (std::size_t i = 0; i < n; ++i) {
    CHECK(distance(by_integers[i], own, double(3 + i), double(4 + i), frame) < 1e-5);
    CHECK(distance(by_fractions[i], own, double(3 + i), double(4 + i), frame) < 1e-5);
  }
}

TEST_CASE("gluNurbsCurve: all loops as one curve is another curve", "[render][nurbs]") {
  auto points = loop(20, Point::Zero());
  const auto second = loop(20, Point(10, 0, 0));
  const BSplineCurve first_alone = control_polygon_curve(points);
  points.insert(points.end(), second.begin(), second.end());
  const LocalFrame frame = frame_of(points);
  std::vector<float> knots;
  for (std::size_t i = 0; i < points.size() + 4; ++i) knots.push_back(float(i));
  const Strips strips = tessellate({4, false, knots, floats(points, frame), 2.5F});
  // In the first loop they agree; where the first should close, the one curve runs across to the second.
  CHECK(distance(strips[0], first_alone, first_alone.knots[3], first_alone.knots[4], frame) < 1e-5);
  CHECK((in_model(strips[18].front(), frame) - Point(5, 0, 0)).norm() < 4);
  CHECK(in_model(strips[18].back(), frame).x() > 5);
}

TEST_CASE("gluNurbsCurve: a rational quadratic is a circle", "[render][nurbs]") {
  CircularArc circle;
  circle.center = Point(1e6, 2, 3);
  circle.axis = Vector(1, 2, 2) / 3;
  circle.radius = 0.25;
  circle.start = circle.end = circle.center + circle.radius * circle.axis.unitOrthogonal();
  circle.angle = 2 * std::numbers::pi;
  const LocalFrame frame{circle.center, circle.radius};
  const Strips strips = tessellate_as_drawn(to_clamped_bspline(circle), frame, 100);
  REQUIRE(strips.size() == 4);
  for (const NurbsStrip& strip : strips) {
    for (const auto& v : strip) {
      CHECK(std::hypot(v[0], v[1], v[2]) == Approx(1).margin(1e-6));
      CHECK(std::abs(Point(v[0], v[1], v[2]).dot(circle.axis)) < 1e-6);
    }
  }
}

TEST_CASE("gluNurbsCurve: what GLU refuses or silently drops is a failure", "[render][nurbs][error]") {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::vector<float> knots = {0, 0, 0, 0, 1, 1, 1, 1};
  std::vector<float> control = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  NurbsCurve curve{4, false, knots, control, 4};
  CHECK_NOTHROW(tessellate(curve));
  SECTION("an order beyond 24") {
    curve.order = 25;
  }
  SECTION("too few control points") {
    curve.control = curve.control.first(9);
  }
  SECTION("a knot that is not a number") {
    knots[5] = nan;
  }
  SECTION("a point that is not a number") {
    control[4] = nan;
  }
  SECTION("knots that decrease") {
    knots[4] = -1;
  }
  SECTION("an empty range") {
    std::fill(knots.begin(), knots.end(), 0.0F);
  }
  SECTION("a weight of zero") {
    control = {0, 0, 0, 1, 1, 0, 0, 1, 1, 1, 0, 0, 0, 1, 0, 1};
    curve.control = control;
    curve.rational = true;
  }
  CHECK_THROWS(tessellate(curve));
}
