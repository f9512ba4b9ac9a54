#pragma once

// A cubic B-spline, one span at a time, in the form that is cheapest to evaluate often.

#include "meshcontour/types.hpp"

namespace meshcontour::detail {

/// C(begin + s) = c0 + s c1 + s^2 c2 + s^3 c3.
struct TaylorPiece {
  double begin = 0;
  Vector c0 = Vector::Zero(), c1 = Vector::Zero(), c2 = Vector::Zero(), c3 = Vector::Zero();

  TaylorPiece() = default;

  /// From the knots and control points of the span, by the control points of the derivatives.
  ///
  /// @param t  points at the knot that begins the span; t[-2] .. t[3] are used, t[0] < t[1].
  /// @param c  points at the first of its four control points.
  TaylorPiece(const double* t, const Point* c) : begin(t[0]) {
    const double low2 = t[0] - t[-2], low1 = t[0] - t[-1], step = t[1] - t[0];
    const double high1 = t[2] - t[0], high2 = t[3] - t[0];
    const Vector d0 = 3 / (step + low2) * (c[1] - c[0]), d1 = 3 / (high1 + low1) * (c[2] - c[1]);
    const Vector d2 = 3 / high2 * (c[3] - c[2]);
    const Vector e0 = 2 / (step + low1) * (d1 - d0), e1 = 2 / high1 * (d2 - d1);
    const Point p0 = (step * c[0] + low2 * c[1]) / (step + low2);
    const Point p1 = (high1 * c[1] + low1 * c[2]) / (high1 + low1);
    c0 = (step * p0 + low1 * p1) / (step + low1);
    c1 = (step * d0 + low1 * d1) / (step + low1);
    c2 = e0 / 2;
    c3 = (e1 - e0) / (6 * step);
  }

  Point position(double s) const { return ((c3 * s + c2) * s + c1) * s + c0; }
  Vector velocity(double s) const { return (3 * s * c3 + 2 * c2) * s + c1; }
  Vector acceleration(double s) const { return 6 * s * c3 + 2 * c2; }
};

}  // namespace meshcontour::detail
