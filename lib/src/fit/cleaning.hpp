#pragma once

// What every fit starts from: distinct consecutive points, and the size of the loop.

#include <cstddef>
#include <span>
#include <vector>

#include "meshcontour/types.hpp"

namespace meshcontour::detail {

/// Consecutive points closer than this share of the box diagonal are one point.
inline constexpr double kRepeatedPoint = 1e-9;

/// The points of a loop without repetitions.
struct CleanedPoints {
  std::vector<Point> points;
  std::vector<std::size_t> origin;  ///< of each point, its index in the input
  double diagonal = 0;              ///< of the input's box, model units
  double dropped = 0;  ///< largest distance of a dropped point to the kept one before it, model units
};

/// The length of the box diagonal of the points; 0 for none.
double box_diagonal(std::span<const Point> points);

/// Drops every point that lies closer than kRepeatedPoint diagonals to the last kept one; in a closed loop
/// the points at the end that lie as close to the first, too. An open chain keeps both its ends. Linear.
CleanedPoints clean_points(std::span<const Point> points, bool closed);

}  // namespace meshcontour::detail
