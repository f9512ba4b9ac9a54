#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <vector>

#include "meshcontour/types.hpp"

namespace meshcontour::detail {

/// Corners of a triangle.
using Corners = std::array<Point, 3>;

/// The point of a triangle, degenerate ones included, that is nearest to p [Ericson 2005, 5.1.5].
Point nearest_point(const Corners& triangle, const Point& p);

/// Triangles in a tree of boxes, for the nearest one to a point.
class TriangleTree {
 public:
  struct Hit {
    double squared = std::numeric_limits<double>::infinity();  ///< distance to the point
    Index triangle = 0;                                        ///< number in the list given
    std::size_t looked_at = 0;                                 ///< triangles of which the distance was taken
  };

  /// O(n log n).
  TriangleTree(std::span<const Point> points, std::span<const Triangle> triangles);

  /// The nearest triangle; of several the one that the search meets first, the same always.
  ///
  /// @param hint  a triangle that may be near, which saves time: the one that was found for a point beside p.
  Hit nearest(const Point& p, Index hint = 0) const;

  /// Corners of a triangle by its number in the list given.
  const Corners& corners(Index triangle) const { return corners_[place_[triangle]]; }
  std::size_t size() const { return corners_.size(); }

 private:
  // The part of space between two parallel planes.
  struct Slab {
    Vector across = Vector::Zero();
    double low = 0, high = 0;  // along it

    double distance(const Point& p) const {
      const double at = across.dot(p);
      return std::max({low - at, at - high, 0.0});
    }
  };

  // Long triangles askew to the axes fill little of a box, and overlap in many: these have a slab besides.
  struct Node {
    Box box;
    Slab slab;                   // along the surface, across the triangles' long sides
    Index first = 0, count = 0;  // of a leaf; an inner node's children follow at `second` and behind itself
    Index second = 0;
    Index sector = kNoSector;
  };

  // Around a point where long triangles meet, the slabs of many nodes overlap; what lies within two slabs
  // along the outermost sides of a node's triangles, and one along the surface, is theirs alone.
  using Sector = std::array<Slab, 3>;
  static constexpr Index kNoSector = 0xffffffff;

  struct Directions;
  void build();
  Directions directions_of(std::span<const Index> triangles) const;
  void bound(Node& node, const Directions& directions, std::span<const Index> triangles);
  Slab slab_of(const Vector& across, std::span<const Index> triangles) const;
  Sector sector_of(const Directions& directions, std::span<const Index> triangles) const;
  Vector cut_direction(const Directions& directions, std::span<const Index> triangles,
                       const std::vector<Point>& centres) const;
  double squared_distance(const Node& node, const Point& p) const;
  void look_at(const Node& leaf, const Point& p, Hit& best) const;

  std::vector<Corners> corners_;  // in the order of the leaves
  std::vector<Index> number_;     // in the list given, of each
  std::vector<Index> place_;      // the inverse
  std::vector<Node> nodes_;
  std::vector<Sector> sectors_;  // of nodes of long triangles
};

}  // namespace meshcontour::detail
