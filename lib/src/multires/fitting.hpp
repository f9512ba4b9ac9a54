#pragma once

#include <array>
#include <span>
#include <vector>

#include "meshcontour/types.hpp"

namespace meshcontour::detail {

/// A place on a triangle: the mean of its corners with weights that sum to 1.
struct VertexMean {
  std::array<Index, 3> vertices{};
  std::array<double, 3> weights{};
};

/// Positions for the vertices that occur in the means with a weight, so that the sum over all points of
/// share * |point - mean|^2 is least. Fixed ones stay; a small pull keeps those that nothing holds near their
/// place.
///
/// @param means   one a point.
/// @param shares  one a point, not negative.
/// @param fixed   one a point.
/// @param points  where they are, also to begin with.
std::vector<Point> fit_vertices(std::span<const VertexMean> means, std::span<const double> shares,
                                const std::vector<bool>& fixed, std::span<const Point> points);

}  // namespace meshcontour::detail
