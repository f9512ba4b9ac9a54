#include "model/triangulate.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>

namespace meshcontour::detail {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using PlanePoint = Kernel::Point_2;
using Position = std::uint32_t;

constexpr std::size_t kTestsPerCorner = 2000;

// A normal that is exact in direction for plane polygons, and an average for others. [Newell; Sutherland,
// Sproull & Schumacker 1974]
Vector newell_normal(std::span<const Point> points, std::span<const Index> corners) {
  const Point& origin = points[corners[0]];
  Vector normal = Vector::Zero();
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    normal += (points[corners[i]] - origin).cross(points[corners[i + 1]] - origin);
  }
  return normal;
}

// The polygon without the coordinate in which its normal is longest, counter-clockwise.
std::vector<PlanePoint> project(std::span<const Point> points, std::span<const Index> corners) {
  const Vector normal = newell_normal(points, corners);
  Eigen::Index dropped = 0;
  normal.cwiseAbs().maxCoeff(&dropped);
  Eigen::Index x = (dropped + 1) % 3, y = (dropped + 2) % 3;
  if (normal[dropped] < 0) std::swap(x, y);
  std::vector<PlanePoint> polygon;
  polygon.reserve(corners.size());
  for (const Index corner : corners) polygon.emplace_back(points[corner][x], points[corner][y]);
  return polygon;
}

bool is_strictly_convex(const std::vector<PlanePoint>& polygon) {
  const std::size_t n = polygon.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (!CGAL::left_turn(polygon[i], polygon[(i + 1) % n], polygon[(i + 2) % n])) return false;
  }
  for (std::size_t i = 1; i + 1 < n; ++i) {
    if (!CGAL::left_turn(polygon[0], polygon[i], polygon[i + 1])) return false;
  }
  return true;
}

// Cuts off ears until a triangle is left. [Meisters 1975]
class EarClipper {
 public:
  EarClipper(const std::vector<PlanePoint>& polygon, std::vector<std::array<Position, 3>>& out)
      : polygon_(polygon), out_(out), left_(polygon.size()), budget_(kTestsPerCorner * polygon.size()) {
    const auto n = static_cast<Position>(polygon.size());
    for (Position i = 0; i < n; ++i) {
      previous_.push_back(i == 0 ? n - 1 : i - 1);
      next_.push_back(i + 1 == n ? 0 : i + 1);
    }
    for (Position i = 0; i < n; ++i) {
      convex_.push_back(turns_left(i));
      if (!convex_[i]) reflex_.push_back(i);
    }
  }

  bool clip() {
    Position corner = 0;
    for (std::size_t misses = 0; left_ > 3; corner = next_[corner]) {
      if (is_ear(corner)) {
        cut(corner);
        misses = 0;
      } else if (++misses > left_ || budget_ == 0) {
        close_with_fan(corner);
        return false;
      }
    }
    out_.push_back({previous_[corner], corner, next_[corner]});
    return turns_left(corner);
  }

 private:
  bool turns_left(Position i) const {
    return CGAL::left_turn(polygon_[previous_[i]], polygon_[i], polygon_[next_[i]]);
  }

  bool is_ear(Position corner) {
    if (!convex_[corner]) return false;
    const PlanePoint &a = polygon_[previous_[corner]], &b = polygon_[corner], &c = polygon_[next_[corner]];
    return std::ranges::none_of(reflex_, [&](Position i) {
      if (budget_ > 0) --budget_;
      const PlanePoint& p = polygon_[i];
      if (convex_[i] || p == a || p == b || p == c) return false;
      return !CGAL::right_turn(a, b, p) && !CGAL::right_turn(b, c, p) && !CGAL::right_turn(c, a, p);
    });
  }

  void unlink(Position corner) {
    next_[previous_[corner]] = next_[corner];
    previous_[next_[corner]] = previous_[corner];
    convex_[corner] = true;  // no longer in the way
    --left_;
  }

  void cut(Position corner) {
    out_.push_back({previous_[corner], corner, next_[corner]});
    unlink(corner);
    for (const Position i : {previous_[corner], next_[corner]}) convex_[i] = convex_[i] || turns_left(i);
    if (++cuts_ % 64 == 0) std::erase_if(reflex_, [&](Position i) { return convex_[i]; });
  }

  void close_with_fan(Position first) {
    for (Position i = next_[first]; next_[i] != first; i = next_[i]) out_.push_back({first, i, next_[i]});
  }

  const std::vector<PlanePoint>& polygon_;
  std::vector<std::array<Position, 3>>& out_;
  std::vector<Position> previous_, next_;
  std::vector<bool> convex_;
  std::vector<Position> reflex_;
  std::size_t left_;
  std::size_t budget_;
  std::size_t cuts_ = 0;
};

}  // namespace

bool triangulate(std::span<const Point> points, std::span<const Index> corners,
                 std::vector<std::array<std::uint32_t, 3>>& out) {
  out.clear();
  if (corners.size() == 3) {
    out.push_back({0, 1, 2});
    return true;
  }
  const std::vector<PlanePoint> polygon = project(points, corners);
  if (!is_strictly_convex(polygon)) return EarClipper(polygon, out).clip();
  for (Position i = 1; i + 1 < polygon.size(); ++i) out.push_back({0, i, i + 1});
  return true;
}

}  // namespace meshcontour::detail
