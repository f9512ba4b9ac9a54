#include "fit/ellipse_fit.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include "fit/closed_conic_fit.hpp"
#include "support/catch.hpp"

using namespace meshcontour;
using namespace meshcontour::detail;

namespace {

constexpr double kPi = std::numbers::pi;

EllipticalArc tilted_ellipse(double ratio) {
  const Eigen::AngleAxisd tilt(1.1, Vector(3, 1, -2).normalized());
  EllipticalArc arc;
  arc.center = {4, 5, 6};
  arc.axis = tilt * Vector::UnitZ();
  arc.major = 8 * (tilt * Vector::UnitX());
  arc.ratio = ratio;
  return arc;
}

Point at(const EllipticalArc& arc, double t) {
  return arc.center + std::cos(t) * arc.major + std::sin(t) * arc.ratio * arc.axis.cross(arc.major);
}

std::vector<Point> on_ellipse(const EllipticalArc& arc, double begin, double end, int chords) {
  std::vector<Point> points;
  for (int i = 0; i <= chords; ++i) points.push_back(at(arc, begin + (end - begin) * i / chords));
  return points;
}

}  // namespace

TEST_CASE("fit_ellipse: a whole ellipse is found exactly", "[fit]") {
  const double ratio = GENERATE(0.9, 0.4, 0.05);
  const EllipticalArc truth = tilted_ellipse(ratio);
  auto points = on_ellipse(truth, 0.2, 0.2 + 2 * kPi, 60);
  points.pop_back();
  const auto fit = fit_ellipse(points, true, 1e-7);
  REQUIRE(fit);
  CHECK(fit->arc.full());
  CHECK((fit->arc.center - truth.center).norm() < 1e-9);
  CHECK(fit->arc.major.norm() == Approx(8).epsilon(1e-10));
  CHECK(fit->arc.ratio == Approx(ratio).epsilon(1e-9));
  CHECK(std::abs(fit->arc.major.normalized().dot(truth.major.normalized())) == Approx(1).epsilon(1e-12));
}

TEST_CASE("fit_ellipse: an arc of it is held at both ends, either way around", "[fit]") {
  const EllipticalArc truth = tilted_ellipse(0.5);
  auto points = on_ellipse(truth, -1, 2.5, 30);
  if (GENERATE(false, true)) std::reverse(points.begin(), points.end());
  const auto fit = fit_ellipse(points, false, 1e-7);
  REQUIRE(fit);
  CHECK(fit->arc.angle == Approx(3.5).epsilon(1e-9));
  CHECK((evaluate(Curve(fit->arc), 1e-12) - points.front()).norm() < 1e-9);
  CHECK((evaluate(Curve(fit->arc), 1 - 1e-12) - points.back()).norm() < 1e-9);
  for (const Point& p : points) CHECK(distance_to_ellipse(fit->arc, p) < 1e-9);
}

TEST_CASE("fit_ellipse: noise moves no end off the curve", "[fit]") {
  std::mt19937 random(11);
  auto points = on_ellipse(tilted_ellipse(0.5), 0, 2, 40);
  for (Point& p : points) {
    for (double& x : p) x += 1e-3 * (static_cast<double>(random()) / 4294967296.0 - 0.5);
  }
  const auto fit = fit_ellipse(points, false, 1e-2);
  REQUIRE(fit);
  CHECK(distance_to_ellipse(fit->arc, points.front()) < 1e-12);
  CHECK(distance_to_ellipse(fit->arc, points.back()) < 1e-12);
}

TEST_CASE("fit_ellipse: other curves are refused", "[fit]") {
  std::vector<Point> sine, saddle;
  for (int i = 0; i <= 30; ++i) {
    sine.push_back({i * 0.2, std::sin(i * 0.2), 0});
    const double t = i * 0.1;
    saddle.push_back({std::cos(t), 0.5 * std::sin(t), 0.1 * std::cos(2 * t)});
  }
  CHECK_FALSE(fit_ellipse(sine, false, 1e-3));
  CHECK_FALSE(fit_ellipse(saddle, false, 1e-3));
}

TEST_CASE("fit_ellipse: an arc whose ends are apart is never a whole ellipse", "[fit]") {
  const double overlap = GENERATE(-1e-10, 1e-10, 3e-7);
  const std::vector<Point> points = on_ellipse(tilted_ellipse(0.999), 0.4, 0.4 + 2 * kPi + overlap, 24);
  const auto fit = fit_ellipse(points, false, 1e-3);
  CHECK((!fit || !fit->arc.full()));
}

TEST_CASE("ellipse_deviation: it bounds what is measured, and is tight", "[fit]") {
  const double ratio = GENERATE(1.0, 0.3, 0.02);
  const int chords = GENERATE(8, 25);
  const EllipticalArc truth = tilted_ellipse(ratio);
  const auto points = on_ellipse(truth, 0.1, 3.1, chords);
  double measured = 0;
  for (int i = 0; i < chords; ++i) {
    const Point &a = points[std::size_t(i)], &b = points[std::size_t(i) + 1];
    for (int k = 0; k <= 50; ++k) {
      const Point p = at(truth, 0.1 + 3.0 * (i + k / 50.0) / chords);
      const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
      measured = std::max(measured, (p - a - t * (b - a)).norm());
    }
  }
  EllipticalArc arc = truth;
  arc.angle = 3;
  const double bound = ellipse_deviation(arc, points, 0);
  CHECK(bound >= measured);
  if (ratio == 1.0) CHECK(bound < 1.01 * measured);
}

TEST_CASE("fit_closed_conic: a circle whose coordinates were rounded is no ellipse", "[fit]") {
  const double ratio = GENERATE(1.0, 0.99);
  EllipticalArc truth = tilted_ellipse(ratio);
  auto points = on_ellipse(truth, 0, 2 * kPi, 18);
  points.pop_back();
  const double scatter = 5e-5 * truth.major.norm();
  for (Point& p : points) p = (p / scatter).array().round() * scatter;
  // The limit is less than the points are off, as where it was guessed from better ones.
  for (const double limit : {0.3, 0.5, 0.8, 1.5}) {
    const auto conic = fit_closed_conic(points, limit * scatter, 20 * scatter, 9);
    if (conic) CHECK(std::holds_alternative<CircularArc>(conic->curve) == (ratio == 1.0));
    if (limit == 1.5) CHECK(conic);
  }
}
