#include "fit/whole_loop.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include "fit/certificate.hpp"
#include "meshcontour/fit.hpp"
#include "support/catch.hpp"
#include "support/curves.hpp"

using namespace meshcontour;
using namespace meshcontour::test;

namespace {

constexpr double kPi = std::numbers::pi;

// An ellipse that lies askew, at n parameters that are neither its arc length nor even.
Point on_ellipse(double s) {
  return {20 * std::cos(s), 8 * std::sin(s) + 0.3 * std::cos(s), 5 * std::cos(s + 1)};
}

std::vector<Point> ellipse_points(int n) {
  std::vector<Point> points;
  for (int i = 0; i < n; ++i) {
    const double s = 2 * kPi * i / n;
    points.push_back(on_ellipse(s + 0.2 * std::sin(s)));
  }
  return points;
}

std::vector<Point> regular_polygon(int n, double radius) {
  std::vector<Point> points;
  for (int i = 0; i < n; ++i) {
    points.push_back({radius * std::cos(2 * kPi * i / n), radius * std::sin(2 * kPi * i / n), 3});
  }
  return points;
}

// Distance of the curve to the true ellipse, from samples of both.
double error(const BSplineCurve& curve) {
  const auto [begin, end] = curve.domain();
  double largest = 0;
  for (int k = 0; k < 2000; ++k) {
    const Point p = evaluate(curve, begin + (end - begin) * k / 2000);
    double s = std::atan2(p.y() / 8, p.x() / 20);
    for (int step = 0; step < 20; ++step) {  // Newton on the distance, derivatives by the closed form
      const Vector d{-20 * std::sin(s), 8 * std::cos(s) - 0.3 * std::sin(s), -5 * std::sin(s + 1)};
      const Vector r = on_ellipse(s) - p;
      s -= r.dot(d) / d.squaredNorm();
    }
    largest = std::max(largest, (on_ellipse(s) - p).norm());
  }
  return largest;
}

void check_periodic(const BSplineCurve& curve, std::size_t n) {
  REQUIRE(curve.periodic);
  REQUIRE(curve.control_points.size() == n + 3);
  REQUIRE(curve.knots.size() == n + 7);
  for (std::size_t i = 0; i < 3; ++i) CHECK(curve.control_points[i] == curve.control_points[n + i]);
  const auto [begin, end] = curve.domain();
  const Eigen::MatrixX3d at_begin = derivatives(curve, begin, 2), at_end = derivatives(curve, end, 2);
  for (int k = 0; k < 3; ++k) {
    CHECK((at_begin.row(k) - at_end.row(k)).norm() < 1e-9 * (1 + at_begin.row(k).norm()));
  }
}

}  // namespace

TEST_CASE("control_polygon_curve: on a circle it errs by 4/3 of the sagitta", "[fit]") {
  const int n = GENERATE(24, 34, 100);
  const std::vector<Point> points = regular_polygon(n, 10);
  const double sagitta = 10 * (1 - std::cos(kPi / n));
  const BSplineCurve curve = control_polygon_curve(points);
  check_periodic(curve, points.size());
  for (int i = 0; i < n; ++i) {
    const Point p = evaluate(curve, i + 3);
    CHECK((p - points[static_cast<std::size_t>((i + 1) % n)]).norm() ==
          Approx(4.0 / 3 * sagitta).epsilon(0.01));
  }
  const auto fitted = detail::closed_control_curve(points);
  CHECK(detail::spline_deviation(fitted.curve, points, fitted.parameters, true) ==
        Approx(4.0 / 3 * sagitta).epsilon(0.01));
}

TEST_CASE("interpolate_closed: the curve meets every point and is smooth", "[fit][property]") {
  std::mt19937 engine(21);
  const std::size_t n = GENERATE(3, 4, 5, 34, 1000);
  std::vector<Point> points;
  for (std::size_t i = 0; i < n; ++i) points.push_back(random_point(engine));
  const auto fitted = detail::closed_interpolation(points);
  check_periodic(fitted.curve, n);
  for (std::size_t i = 0; i < n; ++i)
    CHECK((evaluate(fitted.curve, fitted.parameters[i]) - points[i]).norm() < 1e-12);
  CHECK(interpolate_closed(points).control_points == fitted.curve.control_points);
}

TEST_CASE("interpolate_closed: chords that differ by a million keep it exact", "[fit]") {
  std::vector<Point> points = ellipse_points(40);
  points.insert(points.begin() + 7, points[7] + 1e-6 * (points[8] - points[7]));
  const auto fitted = detail::closed_interpolation(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    CHECK((evaluate(fitted.curve, fitted.parameters[i]) - points[i]).norm() < 1e-12 * 40);
  }
}

TEST_CASE("interpolate_closed: it is of fourth order", "[fit]") {
  // Ten times smaller sagitta: sqrt(10) times as many points.
  const double coarse = error(interpolate_closed(ellipse_points(60)));
  const double fine = error(interpolate_closed(ellipse_points(190)));
  CHECK(coarse / fine >= 50);
  CHECK(coarse < 1e-3);
}

TEST_CASE("open_interpolation: it meets every point, and is of fourth order at its ends too", "[fit]") {
  const auto half = [](int n) {
    std::vector<Point> points;
    for (int i = 0; i <= n; ++i) points.push_back(on_ellipse(0.3 + 2.0 * i / n));
    return points;
  };
  for (const int n : {1, 2, 3, 4, 30}) {
    const std::vector<Point> points = half(n);
    const auto fitted = detail::open_interpolation(points);
    REQUIRE(fitted.parameters.size() == points.size());
    CHECK(fitted.curve.control_points.front() == points.front());
    CHECK(fitted.curve.control_points.back() == points.back());
    for (std::size_t i = 0; i < points.size(); ++i) {
      CHECK((evaluate(fitted.curve, fitted.parameters[i]) - points[i]).norm() < 1e-12);
    }
  }
  CHECK(error(detail::open_interpolation(half(20)).curve) /
            error(detail::open_interpolation(half(63)).curve) >=
        50);
}

TEST_CASE("open_control_curve: it keeps the ends and lies in the hull", "[fit]") {
  const std::vector<Point> all = ellipse_points(12);
  const std::size_t n = GENERATE(2, 3, 4, 5, 12);
  const std::vector<Point> points(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(n));
  const auto fitted = detail::open_control_curve(points);
  CHECK(fitted.curve.control_points.front() == points.front());
  CHECK(fitted.curve.control_points.back() == points.back());
  CHECK(fitted.parameters.size() == n);
  CHECK(fitted.curve.knots.size() == fitted.curve.control_points.size() + 4);
  CHECK(std::ranges::is_sorted(fitted.parameters));
  CHECK(fitted.parameters.back() == fitted.curve.domain().second);
}
