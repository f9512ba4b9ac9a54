#pragma once

#include <algorithm>

#include "meshcontour/types.hpp"

namespace meshcontour::detail {

/// Distance of a point and a line segment.
inline double segment_distance(const Point& p, const Point& start, const Point& end) {
  const Vector along = end - start, to_point = p - start;
  const double squared = along.squaredNorm();
  const double share = squared > 0 ? std::clamp(to_point.dot(along) / squared, 0.0, 1.0) : 0;
  return (to_point - share * along).norm();
}

}  // namespace meshcontour::detail
