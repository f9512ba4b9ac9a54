#pragma once

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
  };

  /// O(n log n).
  TriangleTree(std::span<const Point> points, std::span<const Triangle> triangles);

  /// The nearest triangle; of several the one that the search meets first, the same always.
  Hit nearest(const Point& p) const;

  /// Corners of a triangle by its number in the list given.
  const Corners& corners(Index triangle) const { return corners_[place_[triangle]]; }
  std::size_t size() const { return corners_.size(); }

 private:
  // A box and a slab: long triangles askew to the axes fill little of a box, and overlap in many.
  struct Node {
    Box box;
    Vector across = Vector::Zero();  // along the surface, across the triangles' long sides
    double low = 0, high = 0;        // of the triangles along it
    Index first = 0, count = 0;  // of a leaf; an inner node's children follow at `second` and behind itself
    Index second = 0;
  };

  void build();
  void bound(Node& node, std::span<const Index> triangles) const;
  static double squared_distance(const Node& node, const Point& p);

  std::vector<Corners> corners_;  // in the order of the leaves
  std::vector<Index> number_;     // in the list given, of each
  std::vector<Index> place_;      // the inverse
  std::vector<Node> nodes_;
};

}  // namespace meshcontour::detail
