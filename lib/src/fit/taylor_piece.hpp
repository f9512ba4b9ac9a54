#pragma once

// A cubic B-spline, one span at a time, in the form that is cheapest to evaluate often.

#include "fit/sample_pairs.hpp"
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
    const Pair over3 = 1 / Pair{step + low2, high1 + low1}, over2 = 1 / Pair{step + low1, high1};
    const Pair over1 = 1 / Pair{high2, step};
    const Vector d0 = over3[0] * (c[1] - c[0]), d1 = over3[1] * (c[2] - c[1]), d2 = over1[0] * (c[3] - c[2]);
    const Vector e0 = over2[0] * (d1 - d0), e1 = over2[1] * (d2 - d1);
    const Point p0 = c[0] + low2 * d0, p1 = c[1] + low1 * d1;
    c0 = p0 + low1 * over2[0] * (p1 - p0);
    c1 = 3 * (d0 + low1 * e0);
    c2 = 3 * e0;
    c3 = over1[1] * (e1 - e0);
  }

  Point position(double s) const { return ((c3 * s + c2) * s + c1) * s + c0; }
  Vector velocity(double s) const { return (3 * s * c3 + 2 * c2) * s + c1; }
  Vector acceleration(double s) const { return 6 * s * c3 + 2 * c2; }

  /// From two points to the curve.
  PointPair gap(Pair s, const PointPair& p) const {
    return {((c3.x() * s + c2.x()) * s + c1.x()) * s + (c0.x() - p.x),
            ((c3.y() * s + c2.y()) * s + c1.y()) * s + (c0.y() - p.y),
            ((c3.z() * s + c2.z()) * s + c1.z()) * s + (c0.z() - p.z)};
  }
  PointPair velocity(Pair s) const {
    const Pair s3 = 3 * s;
    return {(s3 * c3.x() + 2 * c2.x()) * s + c1.x(), (s3 * c3.y() + 2 * c2.y()) * s + c1.y(),
            (s3 * c3.z() + 2 * c2.z()) * s + c1.z()};
  }
  PointPair acceleration(Pair s) const {
    const Pair s6 = 6 * s;
    return {s6 * c3.x() + 2 * c2.x(), s6 * c3.y() + 2 * c2.y(), s6 * c3.z() + 2 * c2.z()};
  }
};

}  // namespace meshcontour::detail
