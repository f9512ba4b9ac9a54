#include "write/sampling.hpp"

#include "support/catch.hpp"
#include "unit/write/sample.hpp"

using namespace meshcontour;
using namespace meshcontour::detail;

TEST_CASE("sampled: chords stay within the tolerance of the curve", "[write]") {
  const double tolerance = GENERATE(1e-2, 1e-4);
  for (const Segment& segment : open_kinds()) {
    const std::vector<Point> points = sampled(segment.curve, tolerance);
    REQUIRE(points.size() >= 2);
    CHECK(points.front() == start_of(segment.curve));
    CHECK(points.back() == end_of(segment.curve));
    double largest = 0;
    for (int i = 0; i <= 1000; ++i) {
      const Point p = evaluate(segment.curve, i / 1000.0);
      double best = 1e9;
      for (std::size_t k = 1; k < points.size(); ++k) {
        const Vector d = points[k] - points[k - 1];
        const double t = std::clamp((p - points[k - 1]).dot(d) / d.squaredNorm(), 0.0, 1.0);
        best = std::min(best, (p - points[k - 1] - t * d).norm());
      }
      largest = std::max(largest, best);
    }
    CHECK(largest <= 1.01 * tolerance);
  }
}

TEST_CASE("plane_of: flat within the tolerance, facing up, along an axis where it nearly is", "[write]") {
  const std::vector<Point> square = {{0, 0, 5}, {0, 1, 5}, {1, 1, 5}, {1, 0, 5}};  // clockwise from above
  const auto plane = plane_of(square, 1e-9);
  REQUIRE(plane);
  CHECK(plane->normal == Vector::UnitZ());
  std::vector<Point> bent = square;
  bent[2].z() += 1e-3;
  CHECK_FALSE(plane_of(bent, 1e-4));
  CHECK(plane_of(bent, 1e-3));
  CHECK_FALSE(plane_of({}, 1));
}

TEST_CASE("plane_of: an S that encloses nothing, a line, a point", "[write]") {
  const std::vector<Point> zigzag = {{0, 0, 0}, {1, 1, 0}, {2, 0, 0}, {3, -1, 0}, {4, 0, 0}};
  CHECK(plane_of(zigzag, 1e-9)->normal == Vector::UnitZ());
  const std::vector<Point> line = {{0, 0, 0}, {1, 2, 3}, {2, 4, 6}};
  REQUIRE(plane_of(line, 1e-9));
  CHECK(std::abs(plane_of(line, 1e-9)->normal.dot(Vector(1, 2, 3))) < 1e-12);
  CHECK(plane_of({{1, 2, 3}}, 0));
}

TEST_CASE("upward: towards +z, else +y, else +x", "[write]") {
  CHECK(upward({0, 0, -1}) == Vector(0, 0, 1));
  CHECK(upward({1, -1, 1e-12}) == Vector(-1, 1, -1e-12));
  CHECK(upward({-1, 0, 0}) == Vector(1, 0, 0));
  CHECK(upward({1, 1, 1}) == Vector(1, 1, 1));
}
