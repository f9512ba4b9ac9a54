#include "fit/cleaning.hpp"

#include "support/catch.hpp"

using namespace meshcontour;
using detail::clean_points;

TEST_CASE("clean_points: repeated points go, their neighbours and the map stay", "[fit]") {
  const std::vector<Point> points{{0, 0, 0}, {0, 0, 0}, {1, 0, 0},    {1, 1e-11, 0},
                                  {1, 1, 0}, {0, 1, 0}, {1e-10, 0, 0}};
  const auto closed = clean_points(points, true);
  CHECK(closed.origin == std::vector<std::size_t>{0, 2, 4, 5});
  CHECK(closed.points[1] == points[2]);
  CHECK(closed.dropped == Approx(1e-10));
  CHECK(closed.diagonal == Approx(std::sqrt(2.0)));
  const auto open = clean_points(points, false);
  CHECK(open.origin == std::vector<std::size_t>{0, 2, 4, 5, 6});
}

TEST_CASE("clean_points: an open chain keeps its last point", "[fit]") {
  const std::vector<Point> points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1e-12, 0}};
  const auto open = clean_points(points, false);
  CHECK(open.origin == std::vector<std::size_t>{0, 1, 3});
  CHECK(open.points.back() == points.back());
}

TEST_CASE("clean_points: the same point over and over is one point", "[fit]") {
  const std::vector<Point> points(50, Point(3, 4, 5));
  CHECK(clean_points(points, true).points.size() == 1);
  CHECK(clean_points(points, false).points.size() == 1);
  CHECK(clean_points({}, true).points.empty());
}

TEST_CASE("clean_points: creeping along in small steps is not lost", "[fit]") {
  std::vector<Point> points;
  for (int i = 0; i <= 1000; ++i) points.push_back({i * 0.7e-9, 0, 0});
  points.push_back({1, 0, 0});
  const auto cleaned = clean_points(points, true);
  CHECK(cleaned.points.size() > 400);
  CHECK(cleaned.dropped <= 1e-9);
}

TEST_CASE("clean_points: the kept last point of an open chain has no other within reach", "[fit]") {
  const std::vector<Point> points{{-1, 0, 0}, {0, 0, 0}, {1.000000002e-9, 0, 0}, {3e-18, 0, 0}};
  const auto open = clean_points(points, false);
  CHECK(open.origin == std::vector<std::size_t>{0, 3});
  CHECK(open.dropped == Approx(1e-9));
}
