#include "fit/spline_run.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "support/catch.hpp"
#include "support/curves.hpp"

using namespace meshcontour;
using namespace meshcontour::test;
using detail::fit_spline_run;
using detail::SplineRun;
using detail::SplineRunOptions;

namespace {

constexpr double kPi = std::numbers::pi;

using CurveFunction = std::function<Point(double)>;

Point circle(double s) {
  return {10 * std::cos(s), 10 * std::sin(s), 0};
}
Point ellipse(double s) {
  return {20 * std::cos(s), 8 * std::sin(s), 3 * std::cos(s)};
}
Point saddle(double s) {
  return {6 * std::cos(s), 6 * std::sin(s), std::sqrt(100 - 36 * std::cos(s) * std::cos(s))};
}
Point helix(double s) {
  return {10 * std::cos(s), 10 * std::sin(s), 6 * s / (2 * kPi)};
}

std::vector<Point> sampled(const CurveFunction& f, double begin, double end, int chords, bool closed) {
  std::vector<Point> points;
  for (int i = 0; i < chords + (closed ? 0 : 1); ++i) points.push_back(f(begin + (end - begin) * i / chords));
  return points;
}

double diagonal(const std::vector<Point>& points) {
  Box box;
  for (const Point& p : points) box.extend(p);
  return box.diagonal().norm();
}

SplineRun fit(const std::vector<Point>& points, bool closed, double tolerance) {
  SplineRunOptions options;
  options.closed = closed;
  options.tolerance = tolerance;
  return fit_spline_run(points, options);
}

std::size_t control_count(const SplineRun& run) {
  return run.curve.control_points.size() - (run.curve.periodic ? 3 : 0);
}

// Everything that a result promises, measured without the code that made it.
void check_promises(const SplineRun& run, const std::vector<Point>& points, double tolerance) {
  const bool closed = run.curve.periodic;
  const auto [begin, end] = run.curve.domain();
  REQUIRE(run.parameters.size() == points.size());
  CHECK(run.curve.knots.size() == run.curve.control_points.size() + 4);
  CHECK(std::ranges::is_sorted(run.curve.knots));
  CHECK(std::ranges::is_sorted(run.parameters));
  const auto at = [&, begin = begin, end = end](double u) {
    return evaluate(run.curve, u < begin ? u + (end - begin) : u > end ? u - (end - begin) : u);
  };
  double farthest = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    farthest = std::max(farthest, (at(run.parameters[i]) - points[i]).norm());
  }
  CHECK(farthest == Approx(run.vertex_error).margin(1e-12 * diagonal(points)));
  if (run.accepted) CHECK(farthest <= tolerance * (1 + 1e-9));
  double deviation = farthest;
  for (std::size_t i = 0; i + (closed ? 0 : 1) < points.size(); ++i) {
    const bool last = i + 1 == points.size();
    const double next = last ? run.parameters[0] + (end - begin) : run.parameters[i + 1];
    for (int k = 0; k <= 10; ++k) {
      const Point p = at(run.parameters[i] + (next - run.parameters[i]) * k / 10);
      deviation = std::max(deviation, segment_distance(p, points[i], points[last ? 0 : i + 1]));
    }
  }
  CHECK(run.deviation >= deviation * (1 - 1e-9) - 1e-14 * diagonal(points));
  CHECK(run.deviation <= deviation * 1.2 + 1e-12 * diagonal(points));
  if (closed) {
    for (std::size_t i = 0; i < 3; ++i) {
      CHECK(run.curve.control_points[i] == run.curve.control_points[run.curve.control_points.size() - 3 + i]);
    }
  } else {
    CHECK(evaluate(run.curve, begin) == points.front());
    CHECK(evaluate(run.curve, end) == points.back());
  }
}

}  // namespace

TEST_CASE("fit_spline_run: two points are a line, three a parabola", "[fit]") {
  const std::vector<Point> two{{1, 2, 3}, {4, 6, 3}};
  const SplineRun line = fit(two, false, 1e-4);
  CHECK(line.accepted);
  CHECK(line.curve.control_points.size() == 4);
  CHECK(line.deviation < 1e-14);
  check_promises(line, two, 1e-4);
  const std::vector<Point> three{{0, 0, 0}, {1, 0.1, 0}, {2, 0, 0}};
  const SplineRun parabola = fit(three, false, 1e-4);
  CHECK(parabola.accepted);
  CHECK(parabola.curve.control_points.size() == 4);
  CHECK(derivatives(parabola.curve, 0.3, 3).row(3).norm() < 1e-12);
  check_promises(parabola, three, 1e-4);
}

TEST_CASE("fit_spline_run: smooth loops and runs need few control points", "[fit]") {
  struct Case {
    CurveFunction f;
    double end;
    bool closed;
    std::size_t most;
  };
  const std::vector<Case> cases{{circle, 2 * kPi, true, 10},
                                {saddle, 2 * kPi, true, 15},
                                {ellipse, 2 * kPi, true, 18},
                                {helix, 1.3 * 2 * kPi, false, 16}};
  const int chords = GENERATE(34, 60, 144, 5000);
  for (const Case& c : cases) {
    const std::vector<Point> points = sampled(c.f, 0, c.end, chords, c.closed);
    const double tolerance = 1e-4 * diagonal(points);
    const SplineRun run = fit(points, c.closed, tolerance);
    CHECK(run.accepted);
    CHECK(control_count(run) <= c.most);
    check_promises(run, points, tolerance);
  }
}

TEST_CASE("fit_spline_run: the curve is as near to the truth as to the points", "[fit]") {
  const std::vector<Point> points = sampled(circle, 0, 2 * kPi, GENERATE(34, 200), true);
  const double tolerance = GENERATE(1e-2, 1e-3, 1e-4);
  const SplineRun run = fit(points, true, tolerance);
  CHECK(run.accepted);
  const auto [begin, end] = run.curve.domain();
  for (int k = 0; k < 1000; ++k) {
    const Point p = evaluate(run.curve, begin + (end - begin) * k / 1000);
    CHECK(std::abs(p.norm() - 10) < 2.5 * tolerance);
  }
}

TEST_CASE("fit_spline_run: noise below the tolerance adds few control points", "[fit]") {
  std::mt19937 engine(41);
  std::vector<Point> points = sampled(saddle, 0, 2 * kPi, GENERATE(144, 3000), true);
  const double size = diagonal(points);
  for (Point& p : points) p += 2e-5 * size * random_point(engine);
  const SplineRun run = fit(points, true, 1e-4 * size);
  CHECK(run.accepted);
  CHECK(control_count(run) <= 20);
  check_promises(run, points, 1e-4 * size);
}

TEST_CASE("fit_spline_run: end tangents are kept", "[fit]") {
  const std::vector<Point> points = sampled(helix, 0, 4, 60, false);
  SplineRunOptions options;
  options.tolerance = 1e-4 * diagonal(points);
  options.start_tangent = Vector(0, 10, 6 / (2 * kPi)).normalized();
  options.end_tangent = Vector(-10 * std::sin(4), 10 * std::cos(4), 6 / (2 * kPi)).normalized();
  const SplineRun run = fit_spline_run(points, options);
  CHECK(run.accepted);
  CHECK(control_count(run) <= 16);
  const auto [begin, end] = run.curve.domain();
  const Eigen::MatrixX3d first = derivatives(run.curve, begin, 1), last = derivatives(run.curve, end, 1);
  CHECK(first.row(1).normalized().dot(*options.start_tangent) == Approx(1).epsilon(1e-13));
  CHECK(last.row(1).normalized().dot(*options.end_tangent) == Approx(1).epsilon(1e-13));
  check_promises(run, points, options.tolerance);
}

TEST_CASE("fit_spline_run: scaled by a power of two it is the same to the last bit", "[fit]") {
  const std::vector<Point> points = sampled(helix, 0, 5, 80, false);
  std::vector<Point> scaled;
  for (const Point& p : points) scaled.push_back(p / 1048576);
  const SplineRun run = fit(points, false, 1e-3), small = fit(scaled, false, 1e-3 / 1048576);
  REQUIRE(run.curve.control_points.size() == small.curve.control_points.size());
  for (std::size_t i = 0; i < run.curve.control_points.size(); ++i) {
    CHECK(run.curve.control_points[i] / 1048576 == small.curve.control_points[i]);
  }
  CHECK(run.deviation / 1048576 == small.deviation);
}

TEST_CASE("fit_spline_run: far from the origin it is as good", "[fit]") {
  std::vector<Point> points = sampled(ellipse, 0, 2 * kPi, 80, true);
  const double tolerance = 1e-4 * diagonal(points);
  const std::size_t near = control_count(fit(points, true, tolerance));
  for (Point& p : points) p += Vector(1e6, -1e6, 1e6);
  const SplineRun run = fit(points, true, tolerance);
  CHECK(run.accepted);
  CHECK(control_count(run) <= near + 1);
}

TEST_CASE("fit_spline_run: an overshooting run is refused and its worst chord named", "[fit]") {
  // Two long straight legs and a tight bend of three short chords: no calm spline meets the legs' chords.
  std::vector<Point> points{{0, 0, 0}, {50, 0, 0}, {100, 0, 0}};
  points.insert(points.end(), {{100.5, 0.4, 0}, {100.6, 1, 0}, {100.5, 51, 0}, {100.4, 101, 0}});
  const SplineRun run = fit(points, false, 1e-3);
  CHECK_FALSE(run.accepted);
  CHECK(run.worst_chord < points.size() - 1);
  CHECK(run.deviation > 1e-3);
  check_promises(run, points, 1e-3);
}

TEST_CASE("fit_spline_run: any points at all give a curve that keeps its promises", "[fit][property]") {
  std::mt19937 engine(42);
  for (int trial = 0; trial < 300; ++trial) {
    const bool closed = trial % 2 == 0;
    const std::size_t n = 3 + engine() % 40;
    std::vector<Point> points{random_point(engine)};
    while (points.size() < n) {
      const double step = std::pow(10.0, uniform(engine, -4, 0));
      points.push_back(points.back() + step * random_point(engine).normalized());
    }
    const double tolerance = std::pow(10.0, uniform(engine, -9, -1));
    const SplineRun run = fit(points, closed, tolerance);
    for (const Point& p : run.curve.control_points) CHECK(p.allFinite());
    check_promises(run, points, tolerance);
  }
}
