#include "render/bezier.hpp"

#include <cmath>
#include <numbers>

#include "support/catch.hpp"

using namespace meshcontour;
using namespace meshcontour::detail;

namespace {

BSplineCurve wavy(int degree, bool rational) {
  BSplineCurve curve;
  curve.degree = degree;
  const std::size_t n = 12;
  for (std::size_t i = 0; i < n; ++i) {
    curve.control_points.push_back({std::cos(double(i)), std::sin(2.0 * double(i)), 0.1 * double(i * i)});
    if (rational) curve.weights.push_back(1 + 0.5 * std::sin(double(i)));
  }
  for (std::size_t i = 0; i < n + std::size_t(degree) + 1; ++i) curve.knots.push_back(double(i * i) / 7 - 1);
  if (degree > 1) curve.knots[6] = curve.knots[7];
  return curve;
}

Point on_piece(const BezierCurve& curve, std::size_t piece, double t) {
  const auto degree = std::size_t(curve.degree);
  std::vector<Eigen::Vector4d> p(curve.control.begin() + std::ptrdiff_t(piece * degree),
                                 curve.control.begin() + std::ptrdiff_t((piece + 1) * degree + 1));
  for (std::size_t r = 1; r <= degree; ++r) {
    for (std::size_t i = 0; i + r <= degree; ++i) p[i] = (1 - t) * p[i] + t * p[i + 1];
  }
  return p[0].hnormalized();
}

}  // namespace

TEST_CASE("to_bezier: the pieces are the curve, for any knots", "[render]") {
  const BSplineCurve curve = wavy(GENERATE(1, 2, 3, 5), GENERATE(false, true));
  const Point center(3, -2, 1);
  const BezierCurve bezier = to_bezier(curve, center, 2);
  std::size_t piece = 0;
  for (std::size_t span = std::size_t(curve.degree); span < curve.control_points.size(); ++span) {
    const double begin = curve.knots[span], end = curve.knots[span + 1];
    if (begin == end) continue;
    for (const double t : {0.0, 0.3, 0.9}) {
      const Point there = center + 2 * on_piece(bezier, piece, t);
      CHECK((there - evaluate(curve, begin + t * (end - begin))).norm() < 1e-12);
    }
    ++piece;
  }
  CHECK(piece == bezier.pieces());
}

TEST_CASE("chords: they keep the tolerance, and not by far", "[render]") {
  const BSplineCurve curve = wavy(3, GENERATE(false, true));
  const double tolerance = GENERATE(1e-1, 1e-3, 1e-5);
  const BezierCurve bezier = to_bezier(curve, Point::Zero(), 1);
  for (std::size_t piece = 0; piece < bezier.pieces(); ++piece) {
    const int n = chords(chord_error(bezier, piece), tolerance);
    double largest = 0;
    for (int i = 0; i < n; ++i) {
      const Point a = on_piece(bezier, piece, double(i) / n), b = on_piece(bezier, piece, double(i + 1) / n);
      const Point middle = on_piece(bezier, piece, (i + 0.5) / n);
      const double along =
          std::clamp((middle - a).dot(b - a) / std::max((b - a).squaredNorm(), 1e-300), 0.0, 1.0);
      largest = std::max(largest, (middle - a - along * (b - a)).norm());
    }
    CHECK(largest <= tolerance);
    if (n > 20 && n < 1024 && curve.weights.empty()) CHECK(largest > tolerance / 10);
  }
}

TEST_CASE("chords: a circle of a thousand pixels within a tenth of one", "[render]") {
  CircularArc circle;
  circle.radius = 500;
  circle.start = circle.end = Point(500, 0, 0);
  circle.angle = 2 * std::numbers::pi;
  const BezierCurve bezier = to_bezier(to_clamped_bspline(circle), Point::Zero(), 1);
  for (std::size_t piece = 0; piece < bezier.pieces(); ++piece) {
    const int n = chords(chord_error(bezier, piece), 0.1);
    for (int i = 0; i < n; ++i) {
      const Point middle =
          (on_piece(bezier, piece, double(i) / n) + on_piece(bezier, piece, double(i + 1) / n)) / 2;
      CHECK(500 - middle.norm() < 0.1);
    }
    CHECK(n <= 60);
  }
}

TEST_CASE("join_chords: what is left runs along the row, within the tolerance, and is not many", "[render]") {
  const double tolerance = GENERATE(1e-2, 1e-4);
  std::vector<Point> points;
  for (int i = 0; i <= 2000; ++i) points.push_back(Point(std::cos(i * 1e-3), std::sin(i * 1e-3), 1e-4 * i));
  std::vector<Chord> row;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) row.push_back({points[i], points[i + 1], 1e-7});
  join_chords(row, tolerance);
  CHECK(row.front().start == points.front());
  CHECK(row.back().end == points.back());
  std::size_t first = 0;
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (i > 0) CHECK(row[i].start == row[i - 1].end);
    for (; points[first] != row[i].end; ++first) {
      const Vector along = (row[i].end - row[i].start).normalized();
      CHECK((points[first] - row[i].start).cross(along).norm() <= tolerance);
    }
    CHECK(row[i].error <= tolerance);
  }
  CHECK(double(row.size()) < 2 * 2 / std::sqrt(8 * tolerance) + 2);
}

TEST_CASE("join_chords: chords that are worse than the tolerance, corners and closed rows stay", "[render]") {
  const Point a(0, 0, 0), b(1, 0, 0), c(1, 1, 0), d(2, 0, 0);
  std::vector<Chord> coarse = {{a, b, 0.2}, {b, d, 0}}, corner = {{a, b, 0}, {b, c, 0}},
                     there_and_back = {{a, b, 0}, {b, a, 0}};
  join_chords(coarse, 0.1);
  CHECK(coarse.size() == 2);
  join_chords(corner, 0.1);
  CHECK(corner.size() == 2);
  join_chords(there_and_back, 10);
  CHECK(there_and_back.size() == 2);
}
