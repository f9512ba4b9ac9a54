#include "meshcontour/welding.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/point_attributes.hpp"
#include "model/point_numbering.hpp"

namespace meshcontour {
namespace {

using detail::PointNumbering;

constexpr Index kNone = 0xFFFFFFFF;
constexpr double kMostCells = 1e15;  // in one direction; beyond, cells are finer than the coordinates

// Points that stay, in cells twice the tolerance wide; no cell holds more than a few.
class Grid {
 public:
  Grid(const std::vector<Point>& points, double tolerance) : points_(points), tolerance_(tolerance) {}

  /// The nearest point that stays within the tolerance, or kNone.
  Index nearest(const Point& point) const {
    const Point place = point / (2 * tolerance_), cell = place.array().floor();
    const Vector step = (place - cell).unaryExpr([](double part) { return part < 0.5 ? -1.0 : 1.0; });
    Nearest best{tolerance_ * tolerance_, kNone};
    for (int corner = 0; corner < 8; ++corner) {
      const Vector towards(corner & 1 ? step.x() : 0, corner & 2 ? step.y() : 0, corner & 4 ? step.z() : 0);
      if (const auto number = cells_.find(cell + towards)) search(*number, point, best);
    }
    return best.point;
  }

  void add(Index point) {
    const Point cell = (points_[point] / (2 * tolerance_)).array().floor();
    Index number = 0;
    cells_.add(std::span(&cell, 1), std::span(&number, 1));
    if (number == first_.size()) first_.push_back(kNone);
    next_.resize(points_.size(), kNone);
    next_[point] = first_[number];
    first_[number] = point;
  }

 private:
  struct Nearest {
    double squared_distance;
    Index point;
  };

  void search(Index cell, const Point& point, Nearest& best) const {
    for (Index other = first_[cell]; other != kNone; other = next_[other]) {
      const double distance = (points_[other] - point).squaredNorm();
      if (distance < best.squared_distance || (distance == best.squared_distance && other < best.point)) {
        best = {distance, other};
      }
    }
  }

  const std::vector<Point>& points_;
  double tolerance_;
  PointNumbering cells_;
  std::vector<Index> first_;  // one a cell
  std::vector<Index> next_;   // one a point
};

double largest_coordinate(const std::vector<Point>& points) {
  double largest = 0;
  for (const Point& p : points) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  return largest;
}

// For every point the number of the point that it becomes; `points` keeps those that stay.
std::vector<Index> weld_equal(std::vector<Point>& points) {
  std::vector<Index> numbers(points.size());
  PointNumbering numbering(points.size() / 2);
  numbering.add(points, numbers);
  points = std::move(numbering).take_points();
  return numbers;
}

std::vector<Index> weld_near(std::vector<Point>& points, double tolerance) {
  std::vector<Index> numbers(points.size());
  std::vector<Point> kept;
  kept.reserve(points.size());
  Grid grid(kept, tolerance);
  for (std::size_t i = 0; i < points.size(); ++i) {
    numbers[i] = grid.nearest(points[i]);
    if (numbers[i] != kNone) continue;
    numbers[i] = static_cast<Index>(kept.size());
    kept.push_back(points[i]);
    grid.add(numbers[i]);
  }
  points = std::move(kept);
  return numbers;
}

}  // namespace

std::size_t weld_points(Shell& shell, double tolerance) {
  if (!(tolerance >= 0) || !std::isfinite(tolerance)) {
    throw Error(ErrorCode::Usage, fmt::format("weld tolerance {} is not a length", tolerance));
  }
  const std::size_t before = shell.points.size();
  const bool exact = tolerance == 0 || largest_coordinate(shell.points) / tolerance > kMostCells;
  const std::vector<Index> numbers = exact ? weld_equal(shell.points) : weld_near(shell.points, tolerance);
  // Numbers are given by first appearance, so that an attribute moves down only, and its place was read
  // before.
  Index kept = 0;
  for (std::size_t v = 0; v < before; ++v) {
    if (numbers[v] == kept) detail::copy_point_attributes(shell, v, kept++);
  }
  detail::resize_point_attributes(shell);
  for (Triangle& t : shell.triangles) t = {numbers[t[0]], numbers[t[1]], numbers[t[2]]};
  for (auto& [from, to] : shell.creases) from = numbers[from], to = numbers[to];
  return before - shell.points.size();
}

}  // namespace meshcontour
