#include "model/triangulate.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "support/catch.hpp"

using namespace meshcontour;

namespace {

struct Cut {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  bool simple = false;
};

Cut cut(const std::vector<Point>& polygon) {
  std::vector<Index> corners(polygon.size());
  for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = static_cast<Index>(i);
  Cut result;
  result.simple = detail::triangulate(polygon, corners, result.triangles);
  return result;
}

Vector area_vector(const Point& a, const Point& b, const Point& c) {
  return (b - a).cross(c - a) / 2;
}

Vector polygon_area(const std::vector<Point>& polygon) {
  Vector sum = Vector::Zero();
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    sum += area_vector(polygon[0], polygon[i], polygon[i + 1]);
  return sum;
}

// The boundary of the triangles is the polygon, and inside it every edge is used once each way.
void check_covers(const std::vector<Point>& polygon, const Cut& result) {
  REQUIRE(result.triangles.size() == polygon.size() - 2);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (const auto& t : result.triangles) {
    for (std::size_t k = 0; k < 3; ++k) ++uses[{t[k], t[(k + 1) % 3]}];
  }
  const auto n = static_cast<std::uint32_t>(polygon.size());
  for (const auto& [edge, count] : uses) {
    CHECK(count == 1);
    const bool on_boundary = (edge.first + 1) % n == edge.second;
    CHECK(on_boundary != uses.contains({edge.second, edge.first}));
  }
}

// All triangles run as the polygon does, so that their areas add up without cancelling: nothing overlaps.
void check_no_overlap(const std::vector<Point>& polygon, const Cut& result) {
  const Vector whole = polygon_area(polygon);
  double sum = 0;
  for (const auto& t : result.triangles) {
    const Vector part = area_vector(polygon[t[0]], polygon[t[1]], polygon[t[2]]);
    CHECK(part.dot(whole) > 0);
    sum += part.norm();
  }
  CHECK(sum == Approx(whole.norm()));
}

// A star-shaped polygon with random radii, tilted in space.
std::vector<Point> star(std::mt19937& random, std::size_t n) {
  const Eigen::Quaterniond turn(1, double(random() % 100) / 50 - 1, double(random() % 100) / 50 - 1, 0.3);
  std::vector<Point> polygon;
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * double(i) / double(n),
                 radius = 0.2 + double(random() % 1000) / 1000;
    polygon.push_back(turn.normalized() * Point(radius * std::cos(angle), radius * std::sin(angle), 0));
  }
  return polygon;
}

}  // namespace

TEST_CASE("triangulate: a convex polygon is a fan from its first corner", "[model][triangulate]") {
  const Cut result = cut({{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {2, 2, 0}, {0, 2, 0}});
  CHECK(result.triangles == std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}});
  CHECK(result.simple);
}

TEST_CASE("triangulate: concave quads take the diagonal inside", "[model][triangulate]") {
  const std::vector<Point> arrow = {{0, 0, 0}, {2, 0, 1}, {0.5, 0.5, 0.5}, {0, 2, 1}};
  for (std::size_t first = 0; first < 4; ++first) {
    std::vector<Point> polygon = arrow;
    std::rotate(polygon.begin(), polygon.begin() + static_cast<std::ptrdiff_t>(first), polygon.end());
    const Cut result = cut(polygon);
    CHECK(result.simple);
    check_covers(polygon, result);
    check_no_overlap(polygon, result);
  }
}

TEST_CASE("triangulate: corners on straight sides give no triangle without area", "[model][triangulate]") {
  const std::vector<Point> polygon = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0},
                                      {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}};
  const Cut result = cut(polygon);
  CHECK(result.simple);
  check_covers(polygon, result);
  check_no_overlap(polygon, result);
}

TEST_CASE("triangulate: random star polygons are covered without overlap, either way round",
          "[model][triangulate][property]") {
  std::mt19937 random(1);
  for (int round = 0; round < 200; ++round) {
    std::vector<Point> polygon = star(random, 4 + random() % 40);
    if (round % 2 == 1) std::ranges::reverse(polygon);
    const Cut result = cut(polygon);
    CHECK(result.simple);
    check_covers(polygon, result);
    check_no_overlap(polygon, result);
  }
}

TEST_CASE("triangulate: polygons that cross themselves or are flat still close", "[model][triangulate]") {
  const std::vector<std::vector<Point>> polygons = {
      {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}},               // a bow tie
      {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {1.5, 0, 0}},  // a line
      {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}},               // a point
      {{0, 0, 0}, {1e300, 0, 0}, {1e300, 1e300, 0}, {-1e300, 1e300, 1e300}, {2e299, 3e299, 0}}};
  for (const auto& polygon : polygons) {
    const Cut result = cut(polygon);
    CHECK(result.triangles.size() == polygon.size() - 2);
  }
  CHECK_FALSE(cut(polygons[0]).simple);
  CHECK_FALSE(cut(polygons[1]).simple);
}

TEST_CASE("triangulate: a comb of many teeth ends in reasonable time", "[model][triangulate]") {
  std::vector<Point> comb;
  const int teeth = 20'000;
  for (int i = 0; i < teeth; ++i) {
    comb.push_back({double(i), 0, 0});
    comb.push_back({i + 0.5, 100, 0});
  }
  comb.push_back({double(teeth), -1, 0});
  comb.push_back({-1, -1, 0});
  std::ranges::reverse(comb);
  const Cut result = cut(comb);
  CHECK(result.triangles.size() == comb.size() - 2);
}
