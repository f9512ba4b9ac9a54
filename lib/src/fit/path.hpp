#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "meshcontour/types.hpp"

namespace meshcontour::detail {

/// The distinct points of a chain, relative to the first of them, with what its chords say.
///
/// Always in open form: of a closed chain the first point is repeated at the end, so that vertex 0 and vertex
/// n are the same place, and any vertex can be made the first.
struct Path {
  std::vector<Point> points;        ///< n + 1 for n chords
  std::vector<std::size_t> source;  ///< for each point its index in the chain
  std::vector<double> length;       ///< of each chord
  std::vector<double> turn;      ///< at each point the angle between its chords, radians; pi at an open end
  Point origin = Point::Zero();  ///< what was subtracted from the points
  double extent = 0;             ///< box diagonal
  double dropped = 0;            ///< largest distance of a dropped point to the one kept in its place
  bool closed = false;

  std::size_t chords() const { return length.size(); }

  /// A point before the first or after the last: of a closed path by going on around it, else nothing.
  const Point* beyond(std::size_t position, std::ptrdiff_t steps) const;

  /// Points begin .. end, both included.
  std::span<const Point> run(std::size_t begin, std::size_t end) const {
    return std::span(points).subspan(begin, end - begin + 1);
  }
};

/// @param points  of the chain; closed: the first not repeated. Repeated points are dropped, see
/// clean_points.
Path make_path(std::span<const Point> points, bool closed);

/// The same closed path, started at another of its points.
Path rotated(const Path& path, std::size_t start);

}  // namespace meshcontour::detail
