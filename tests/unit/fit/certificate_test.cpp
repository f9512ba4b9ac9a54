#include "fit/certificate.hpp"

#include <algorithm>
#include <numbers>
#include <random>

#include "support/catch.hpp"
#include "support/curves.hpp"

using namespace meshcontour;
using namespace meshcontour::test;

namespace {

// Largest distance of the curve to the polygon of its own points, each piece to its own chord, by 200 samples
// a chord.
double sampled(const BSplineCurve& curve, const std::vector<Point>& points, const std::vector<double>& t,
               bool closed) {
  double largest = 0;
  const auto [begin, end] = curve.domain();
  for (std::size_t i = 0; i + (closed ? 0 : 1) < points.size(); ++i) {
    const bool last = i + 1 == points.size();
    const Point& stop = points[last ? 0 : i + 1];
    const double next = last ? t[0] + (end - begin) : t[i + 1];
    for (int k = 0; k < 200; ++k) {
      double u = t[i] + (next - t[i]) * k / 199;
      if (closed && u >= end) u -= end - begin;
      largest = std::max(largest, segment_distance(evaluate(curve, u), points[i], stop));
    }
  }
  return largest;
}

}  // namespace

TEST_CASE("spline_deviation: never below a sampled maximum and rarely far above", "[fit][property]") {
  std::mt19937 engine(11);
  std::vector<double> ratios;
  for (int trial = 0; trial < 1000; ++trial) {
    const bool closed = trial % 2 == 0;
    const std::size_t count = 4 + engine() % 12;
    const BSplineCurve curve =
        closed ? random_periodic(engine, count) : random_curve(engine, 3, count, true, false);
    const auto [begin, end] = curve.domain();
    const std::size_t chords = 1 + engine() % 20;
    std::vector<double> t;
    std::vector<Point> points;
    for (std::size_t i = 0; i < chords + (closed ? 0 : 1); ++i) {
      t.push_back(begin + (end - begin) * static_cast<double>(i) / static_cast<double>(chords));
      points.push_back(evaluate(curve, t.back()) + random_point(engine, 0.01));
    }
    const double bound = detail::spline_deviation(curve, points, t, closed);
    const double samples = sampled(curve, points, t, closed);
    CHECK(bound >= samples * (1 - 1e-14));
    ratios.push_back(bound / samples);
  }
  std::ranges::sort(ratios);
  CHECK(ratios[500] < 1.02);
  CHECK(ratios[999] < 1.1);
}

TEST_CASE("chord_deviation: the hull is enough when it is below what is enough", "[fit]") {
  std::mt19937 engine(12);
  const BSplineCurve curve = random_curve(engine, 3, 4, true, false);
  const auto [begin, end] = curve.domain();
  const Point a = evaluate(curve, begin), b = evaluate(curve, end);
  const double tight = detail::chord_deviation(curve, begin, end, a, b);
  double hull = 0;
  for (const Point& p : curve.control_points) hull = std::max(hull, segment_distance(p, a, b));
  CHECK(tight < hull);
  CHECK(detail::chord_deviation(curve, begin, end, a, b, 2 * hull) == Approx(hull).epsilon(1e-14));
}

TEST_CASE("line_deviation: the farthest point", "[fit]") {
  const LineSegment line{{0, 0, 0}, {10, 0, 0}};
  CHECK(detail::line_deviation(line, std::vector<Point>{{0, 0, 0}, {3, 0.2, 0}, {10, 0, 0}}) == Approx(0.2));
  CHECK(detail::line_deviation(line, std::vector<Point>{{0, 0, 0}, {13, 4, 0}, {10, 0, 0}}) == Approx(5));
  CHECK(detail::line_deviation(line, std::vector<Point>{{1, 0, 0}, {10, 0, 0}}) == Approx(1));
}

TEST_CASE("arc_deviation: sagitta of exact points, and no less with noise", "[fit][property]") {
  std::mt19937 engine(13);
  for (int trial = 0; trial < 200; ++trial) {
    const bool full = trial % 3 == 0;
    const double sweep = full ? 2 * std::numbers::pi : uniform(engine, 0.1, 6);
    const double noise = trial % 2 == 0 ? 0 : 0.01;
    const int chords = 2 + static_cast<int>(engine() % 30);
    CircularArc arc{{5, 0, 0}, {}, {0, 0, 0}, {0, 0, 1}, 5, sweep};
    std::vector<Point> points;
    for (int i = 0; i < chords + (full ? 0 : 1); ++i) {
      const double angle = sweep * i / chords;
      points.push_back(Point(5 * std::cos(angle), 5 * std::sin(angle), 0) + noise * random_point(engine));
    }
    if (!full) {
      points.front() = arc.start;
      points.back() = {5 * std::cos(sweep), 5 * std::sin(sweep), 0};
    }
    arc.end = full ? arc.start : points.back();
    const double bound = detail::arc_deviation(arc, points);
    const double sagitta = 5 * (1 - std::cos(sweep / chords / 2));
    if (noise == 0) CHECK(bound == Approx(sagitta).epsilon(1e-9));
    double sampled_distance = 0;
    for (int k = 0; k <= 2000; ++k) {
      const Point p = evaluate(arc, k / 2000.0);
      double nearest = 1e9;
      for (std::size_t i = 0; i + (full ? 0 : 1) < points.size(); ++i) {
        nearest = std::min(nearest, segment_distance(p, points[i], points[(i + 1) % points.size()]));
      }
      sampled_distance = std::max(sampled_distance, nearest);
    }
    CHECK(bound >= sampled_distance * (1 - 1e-12));
  }
}

TEST_CASE("arc_deviation: points that run the other way round are far from the arc", "[fit]") {
  const CircularArc arc{{5, 0, 0}, {0, 5, 0}, {0, 0, 0}, {0, 0, 1}, 5, std::numbers::pi / 2};
  std::vector<Point> points;
  for (int i = 0; i <= 30; ++i)
    points.push_back({5 * std::cos(-i * 0.157079633), 5 * std::sin(-i * 0.157079633), 0});
  points.back() = arc.end;
  CHECK(detail::arc_deviation(arc, points) > 5);
}
