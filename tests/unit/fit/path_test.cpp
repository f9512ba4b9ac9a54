#include "fit/path.hpp"

#include <numbers>

#include "support/catch.hpp"

using namespace meshcontour;
using detail::make_path;

TEST_CASE("make_path: a closed chain in one place has no chords and no turn of its own", "[fit]") {
  const std::vector<Point> points(4, Point(1, 2, 3));
  const detail::Path path = make_path(points, true);
  CHECK(path.chords() == 0);
  CHECK(path.points == std::vector<Point>{Point::Zero()});
  CHECK(path.turn == std::vector<double>{std::numbers::pi});
}

TEST_CASE("make_path: a closed chain repeats its first point and turns there", "[fit]") {
  const std::vector<Point> square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const detail::Path path = make_path(square, true);
  REQUIRE(path.chords() == 4);
  CHECK(path.points.front() == path.points.back());
  for (const double turn : path.turn) CHECK(turn == Approx(std::numbers::pi / 2));
}
