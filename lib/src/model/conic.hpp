#pragma once

// Circles and ellipses as one thing: center + cos(t) first + sin(t) second.

#include "meshcontour/curve.hpp"

namespace meshcontour::detail {

/// A piece of a conic around its center, t from `begin` over `angle`.
struct ConicFrame {
  Point center;
  Vector first, second;  ///< half-diameters; conjugate, for our own arcs perpendicular
  double begin = 0;      ///< radians
  double angle = 0;      ///< radians
  Point start, end;      ///< the exact ends, which the formula meets to rounding only

  Point at(double t) const { return center + std::cos(t) * first + std::sin(t) * second; }
  /// Speed at t.
  double speed(double t) const { return (std::cos(t) * second - std::sin(t) * first).norm(); }
};

ConicFrame conic_frame(const CircularArc& arc);
ConicFrame conic_frame(const EllipticalArc& arc);

}  // namespace meshcontour::detail
