#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "meshcontour/remeshing.hpp"

namespace meshcontour::detail {

/// Changes of a triangle mesh, each of them a piece of it laid out in the plane once and covered twice: by
/// the triangles that were there and by those that took their place. What is known of the result is a map
/// from each of its places back to the mesh at the beginning, one to one [Lee et al. 1998; Liu et al. 2020].
class ChartSequence {
 public:
  using PlanePoint = Eigen::Vector2d;
  using Corners = std::array<std::uint8_t, 3>;  ///< of a triangle, as points of the chart

  struct Face {
    Index slot = 0;  ///< where the triangle is stored; its corners below are in that order
    Corners corners{};
  };

  explicit ChartSequence(std::size_t triangles);

  /// Adds a change.
  ///
  /// @param points  at most 255.
  /// @param before  the triangles that were there, counter-clockwise in the chart.
  /// @param after   those that cover the same part of it; their slots are among those of `before`.
  void add(std::span<const PlanePoint> points, std::span<const Face> before, std::span<const Face> after);

  /// Where a place on a triangle of the result lies on the mesh at the beginning; about as many steps as
  /// there were changes around it.
  SurfacePlace origin(const SurfacePlace& place) const;

 private:
  // A triangle as a change made it or found it.
  struct Version {
    Index number = 0;  // of the triangles at the beginning their own, then counted on
    Corners corners{};
  };
  struct Made {
    Index change = 0;
    Corners corners{};
  };

  Version locate(Index change, const PlanePoint& p, std::array<double, 3>& weights) const;

  Index triangles_;
  std::vector<Index> current_;            // one a slot: its version
  std::vector<Made> made_;                // one a version behind the first ones
  std::vector<std::size_t> first_point_;  // one a change and one more
  std::vector<std::size_t> first_before_;
  std::vector<PlanePoint> points_;
  std::vector<Version> before_;
};

}  // namespace meshcontour::detail
