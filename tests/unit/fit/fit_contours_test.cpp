#include <limits>
#include <numbers>
#include <random>

#include "fit/arc_fit.hpp"
#include "fit/ellipse_fit.hpp"
#include "meshcontour/fit.hpp"
#include "support/catch.hpp"
#include "support/curves.hpp"

using namespace meshcontour;

namespace {

// A model of loops only: what fit_contours reads of it.
struct Loops {
  Model model;
  std::vector<ShellBoundary> boundaries;

  Loops() : model(), boundaries(1) {
    model.shells.emplace_back();
    model.shells[0].id = "part";
  }

  void add(const std::vector<Point>& points, bool closed = true) {
    Shell& shell = model.shells[0];
    std::vector<Index> vertices;
    for (const Point& p : points) {
      vertices.push_back(static_cast<Index>(shell.points.size()));
      shell.points.push_back(p);
    }
    PatchBoundary patch;
    patch.loops = {BoundaryLoop{vertices, closed}};
    boundaries[0].patches.push_back(patch);
  }

  /// A loop of points that are there already.
  void add_of(const std::vector<Index>& vertices) {
    PatchBoundary patch;
    patch.loops = {BoundaryLoop{vertices, true}};
    boundaries[0].patches.push_back(patch);
  }

  std::vector<Contour> fit(FitMethod method, std::vector<Diagnostic>& diagnostics,
                           unsigned threads = 1) const {
    FitOptions options;
    options.method = method;
    options.threads = threads;
    return fit_contours(model, boundaries, options, diagnostics);
  }
};

std::vector<Point> circle(int n, double radius, const Point& center = Point::Zero()) {
  std::vector<Point> points;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n;
    points.push_back(center + radius * Vector(std::cos(angle), std::sin(angle), 0));
  }
  return points;
}

}  // namespace

TEST_CASE("fit_contours: one contour a loop, in order, whatever the threads", "[fit]") {
  Loops loops;
  for (int i = 0; i < 40; ++i) loops.add(circle(3 + i, 1 + i), i % 5 != 0);
  const FitMethod method = GENERATE(FitMethod::Control, FitMethod::Interpolate);
  std::vector<Diagnostic> diagnostics;
  const auto contours = loops.fit(method, diagnostics);
  const auto parallel = loops.fit(method, diagnostics, 4);
  REQUIRE(contours.size() == 40);
  CHECK(diagnostics.empty());
  for (std::size_t i = 0; i < 40; ++i) {
    CHECK(contours[i].patch == i);
    CHECK(contours[i].closed == (i % 5 != 0));
    CHECK_FALSE(contours[i].fallback);
    REQUIRE(contours[i].segments.size() == 1);
    const Segment& segment = contours[i].segments[0];
    CHECK(segment.from == loops.boundaries[0].patches[i].loops[0].vertices.front());
    CHECK((segment.from == segment.to) == contours[i].closed);
    CHECK(contours[i].deviation > 0);
    CHECK(contours[i].deviation == parallel[i].deviation);
    CHECK(std::get<BSplineCurve>(segment.curve).control_points ==
          std::get<BSplineCurve>(parallel[i].segments[0].curve).control_points);
  }
}

TEST_CASE("fit_contours: repeated points change nothing", "[fit]") {
  const std::vector<Point> points = circle(12, 5);
  std::vector<Point> repeated;
  for (const Point& p : points) repeated.insert(repeated.end(), {p, p});
  repeated.push_back(points.front());
  Loops loops;
  loops.add(points);
  loops.add(repeated);
  std::vector<Diagnostic> diagnostics;
  const auto contours = loops.fit(FitMethod::Interpolate, diagnostics);
  CHECK(std::get<BSplineCurve>(contours[0].segments[0].curve).control_points ==
        std::get<BSplineCurve>(contours[1].segments[0].curve).control_points);
}

TEST_CASE("fit_contours: parts of a noisy circle or ellipse run through their joints", "[fit]") {
  // A ring of 28 points that seven patches share with the one inside it, four chords each.
  const double ratio = GENERATE(1.0, 0.7);
  std::mt19937 engine(5);
  Loops loops;
  std::vector<Point> ring = circle(28, 10);
  for (Point& p : ring) p = Point(p.x(), ratio * p.y(), 0) + 2e-5 * test::random_point(engine);
  loops.add(ring);
  for (Index k = 0; k < 7; ++k) {
    std::vector<Index> vertices;
    for (Index i = 4; i + 1 > 0; --i) vertices.push_back((4 * k + i) % 28);
    for (const Index end : {4 * k, (4 * k + 4) % 28}) {
      vertices.push_back(static_cast<Index>(loops.model.shells[0].points.size()));
      loops.model.shells[0].points.push_back(ring[end] - Vector(0, 0, 5));
    }
    loops.add_of(vertices);
  }
  std::vector<Diagnostic> diagnostics;
  const auto contours = loops.fit(FitMethod::Primitives, diagnostics);
  std::size_t parts = 0;
  for (const Contour& contour : contours) {
    for (const Segment& segment : contour.segments) {
      if (const auto* arc = std::get_if<CircularArc>(&segment.curve); arc != nullptr && !arc->full()) {
        ++parts;
        CHECK((evaluate(segment.curve, 1) - arc->end).norm() < 1e-12);
        CHECK((arc->start - arc->center).norm() == Approx(arc->radius).epsilon(1e-13));
      }
      if (const auto* arc = std::get_if<EllipticalArc>(&segment.curve); arc != nullptr && !arc->full()) {
        ++parts;
        CHECK((evaluate(segment.curve, 1) - arc->end).norm() < 1e-12);
        CHECK(detail::distance_to_ellipse(*arc, arc->start) < 1e-12);
      }
    }
  }
  CHECK(parts == 7);
  CHECK(contours[0].segments.size() == 1);
}

TEST_CASE("fit_contours: rounded coordinates do not widen the tolerance of a ring in parts", "[fit]") {
  std::vector<Point> ring = circle(28, 10);
  for (Point& p : ring) p = p.cast<float>().cast<double>();
  Loops loops;
  loops.add(ring);
  for (const Index first : {0U, 14U}) {
    std::vector<Index> vertices;
    for (Index i = 14; i + 1 > 0; --i) vertices.push_back((first + i) % 28);
    vertices.push_back(static_cast<Index>(loops.model.shells[0].points.size()));
    loops.model.shells[0].points.push_back({0, 0, 5});
    loops.add_of(vertices);
  }
  FitOptions options;
  options.tolerance = 1e-8;  // less than the points are off
  std::vector<Diagnostic> diagnostics;
  for (const Contour& contour : fit_contours(loops.model, loops.boundaries, options, diagnostics)) {
    for (const Segment& segment : contour.segments) {
      const auto* arc = std::get_if<CircularArc>(&segment.curve);
      if (arc == nullptr) continue;
      for (const Point& p : ring) CHECK(detail::distance_to_circle(*arc, p) <= options.tolerance);
    }
  }
}

TEST_CASE("fit_contours: edges too short to have a square are their chords", "[fit]") {
  const double size = GENERATE(1e-90, 1e-170, 1e-310);
  Loops loops;
  Shell& shell = loops.model.shells[0];
  for (int i = 0; i < 9; ++i) shell.points.push_back(size * Point(std::cos(i / 8.0), std::sin(i / 8.0), 0));
  for (const Point& p : {Point(0, 1, 0), Point(1, 0, 0), Point(0, -1, 0), Point(-1, 0, 0)})
    shell.points.push_back(p);
  loops.add_of({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10});
  loops.add_of({8, 7, 6, 5, 4, 3, 2, 1, 0, 11, 12});
  std::vector<Diagnostic> diagnostics;
  for (const Contour& contour : loops.fit(FitMethod::Primitives, diagnostics)) {
    CHECK_FALSE(contour.fallback);
    CHECK(contour.segments.size() == 11);
    for (const Segment& segment : contour.segments) {
      CHECK(std::holds_alternative<LineSegment>(segment.curve));
      CHECK(segment.deviation <= size);
    }
  }
}

TEST_CASE("fit_contours: what cannot be fitted is its polygon, and said so", "[fit][error]") {
  Loops loops;
  loops.add(circle(8, 1));
  loops.add({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}});
  loops.add({{0, 0, 0}, {1, 0, 0}, {1, 1e-12, 0}});
  loops.add(circle(5, 1e200));
  loops.add({{-1e308, -1e308, 0}, {1e308, 1e308, 0}, {0, 1e308, 0}});
  const FitMethod method = GENERATE(FitMethod::Control, FitMethod::Interpolate);
  std::vector<Diagnostic> diagnostics;
  const auto contours = loops.fit(method, diagnostics);
  CHECK_FALSE(contours[0].fallback);
  CHECK(contours[1].fallback);
  CHECK(contours[1].segments.size() == 1);
  CHECK(contours[2].segments.size() == 2);
  CHECK(std::get<LineSegment>(contours[2].segments[0].curve).end == Point(1, 0, 0));
  CHECK(contours[3].segments.size() == 5);
  CHECK(contours[4].fallback);
  REQUIRE(diagnostics.size() == 2);
  CHECK(diagnostics[0].count == 2);
  CHECK(diagnostics[0].text().find("shell part, patch 2, loop 1") != std::string::npos);
  CHECK(diagnostics[1].count == 2);
}

TEST_CASE("fit_contours: a loop in one place stays there at any tolerance", "[fit][error]") {
  Loops loops;
  loops.add(std::vector<Point>(4, Point(1, 2, 3)));
  FitOptions options;
  options.method = GENERATE(FitMethod::Primitives, FitMethod::Approximate);
  options.tolerance = GENERATE(0.0, 1e-3);
  std::vector<Diagnostic> diagnostics;
  const auto contours = fit_contours(loops.model, loops.boundaries, options, diagnostics);
  REQUIRE(contours.size() == 1);
  CHECK(contours[0].fallback);
  REQUIRE(contours[0].segments.size() == 1);
  CHECK(std::get<LineSegment>(contours[0].segments[0].curve).start == Point(1, 2, 3));
}

TEST_CASE("fit_contours: options out of range are refused", "[fit][error]") {
  const Loops loops;
  std::vector<Diagnostic> diagnostics;
  FitOptions options;
  options.tolerance =
      GENERATE(-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity());
  CHECK_THROWS_AS(fit_contours(loops.model, loops.boundaries, options, diagnostics), Error);
  options.tolerance = 0;
  options.corner_angle = GENERATE(0.0, -1.0, 4.0);
  CHECK_THROWS_AS(fit_contours(loops.model, loops.boundaries, options, diagnostics), Error);
}
