#include "fit/arc_fit.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include "support/catch.hpp"

using namespace meshcontour;
using namespace meshcontour::detail;

namespace {

constexpr double kPi = std::numbers::pi;

// Points of a circle in a tilted plane, steps not equal.
std::vector<Point> on_circle(const Point& center, double radius, double begin, double end, int chords) {
  const Eigen::AngleAxisd tilt(0.7, Vector(1, 2, 3).normalized());
  std::vector<Point> points;
  for (int i = 0; i <= chords; ++i) {
    const double s = static_cast<double>(i) / chords,
                 t = begin + (end - begin) * (s + 0.05 * std::sin(2 * kPi * s));
    points.push_back(center + radius * (tilt * Vector(std::cos(t), std::sin(t), 0)));
  }
  return points;
}

}  // namespace

TEST_CASE("fit_arc: centre, radius and angle of any arc are exact", "[fit]") {
  const double sweep = GENERATE(0.02, 0.5, 2.0, kPi, 5.0, 6.2);
  const int chords = GENERATE(8, 40, 500);
  const Point center(3, -2, 5);
  const auto points = on_circle(center, 7, 0.3, 0.3 + sweep, chords);
  const auto fit = fit_arc(points, 1e-9);
  REQUIRE(fit);
  const double flatness = 1 - std::cos(std::min(sweep, kPi) / 2);
  CHECK((fit->arc.center - center).norm() < 1e-14 * 7 / flatness + 1e-12);
  CHECK(fit->arc.radius == Approx(7).margin(1e-14 * 7 / flatness + 1e-12));
  CHECK(fit->arc.angle == Approx(sweep).epsilon(1e-9));
  CHECK(fit->arc.start == points.front());
  CHECK(fit->arc.end == points.back());
  CHECK(fit->residual < 1e-12);
}

TEST_CASE("fit_arc: the axis follows the direction of the points", "[fit]") {
  auto points = on_circle({0, 0, 0}, 1, 0, 2, 10);
  const Vector axis = fit_arc(points, 1e-9)->arc.axis;
  std::reverse(points.begin(), points.end());
  CHECK((fit_arc(points, 1e-9)->arc.axis + axis).norm() < 1e-12);
}

TEST_CASE("fit_arc: both ends are held though the points are noisy", "[fit]") {
  std::mt19937 random(5);
  auto points = on_circle({0, 0, 0}, 10, 0, 2, 60);
  for (Point& p : points) {
    for (double& x : p) x += 1e-4 * (static_cast<double>(random()) / 4294967296.0 - 0.5);
  }
  const auto fit = fit_arc(points, 1e-3);
  REQUIRE(fit);
  CHECK(distance_to_circle(fit->arc, points.front()) < 1e-12);
  CHECK(distance_to_circle(fit->arc, points.back()) < 1e-12);
  CHECK(fit->arc.radius == Approx(10).epsilon(1e-4));
  double worst = 0;
  for (const Point& p : points) worst = std::max(worst, distance_to_circle(fit->arc, p));
  CHECK(fit->residual == worst);
}

TEST_CASE("fit_arc: what is no arc is refused", "[fit]") {
  const auto parabola = [] {
    std::vector<Point> points;
    for (int i = 0; i <= 20; ++i) points.push_back({i / 20.0, i * i / 400.0, 0});
    return points;
  }();
  CHECK_FALSE(fit_arc(parabola, 1e-4));
  const std::vector<Point> line = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  CHECK_FALSE(fit_arc(line, 1e-6));
  const std::vector<Point> zigzag = {{0, 0, 0}, {1, 1, 0}, {2, 0, 0}, {3, 1, 0}, {4, 0, 0}};
  CHECK_FALSE(fit_arc(zigzag, 1e-6));
  const std::vector<Point> wide_steps = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  CHECK_FALSE(fit_arc(wide_steps, 1e-6));
  const std::vector<Point> same_ends = {{1, 0, 0}, {0, 1, 0}, {1, 0, 0}};
  CHECK_FALSE(fit_arc(same_ends, 1e-6));
}

TEST_CASE("fit_circle: a ring of points is a full circle, starting at the first", "[fit]") {
  const int chords = GENERATE(9, 34, 1000);
  auto ring = on_circle({100, 200, -300}, 2.5, 0.4, 0.4 + 2 * kPi, chords);
  ring.pop_back();
  const auto fit = fit_circle(ring, 1e-9);
  REQUIRE(fit);
  CHECK(fit->arc.full());
  CHECK((fit->arc.center - Point(100, 200, -300)).norm() < 1e-11);
  CHECK(fit->arc.radius == Approx(2.5).epsilon(1e-12));
  CHECK((fit->arc.start - ring[0]).norm() < 1e-11);
  CHECK(fit->arc.start == fit->arc.end);
}

TEST_CASE("fit_circle: two turns, a figure eight and a dent are refused", "[fit]") {
  auto twice = on_circle({0, 0, 0}, 1, 0, 4 * kPi, 40);
  twice.pop_back();
  CHECK_FALSE(fit_circle(twice, 1e-3));
  std::vector<Point> eight;
  for (int i = 0; i < 40; ++i) eight.push_back({std::sin(i * kPi / 20), std::sin(i * kPi / 10), 0});
  CHECK_FALSE(fit_circle(eight, 1e-3));
  auto dented = on_circle({0, 0, 0}, 1, 0, 2 * kPi, 40);
  dented.pop_back();
  dented[7] *= 0.98;
  CHECK_FALSE(fit_circle(dented, 1e-3));
}

TEST_CASE("line_residual: the farthest point, and nothing for points that turn back", "[fit]") {
  const std::vector<Point> bent = {{0, 0, 0}, {1, 0.01, 0}, {2, 0, 0.02}, {3, 0, 0}};
  CHECK(line_residual(bent, 0.1).value() == Approx(0.02));
  CHECK_FALSE(line_residual(bent, 0.015));
  const std::vector<Point> back = {{0, 0, 0}, {2, 0, 0}, {1, 0, 0}, {3, 0, 0}};
  CHECK_FALSE(line_residual(back, 0.1));
}
