#pragma once

#include <vector>

#include "meshcontour/curve.hpp"

namespace meshcontour::detail {

/// A curve as consecutive Bezier pieces: piece i has the control points degree * i to degree * (i + 1).
struct BezierCurve {
  int degree = 3;
  std::vector<Eigen::Vector4d> control;  ///< (w x, w y, w z, w)
  bool rational = false;

  std::size_t pieces() const {
    return control.empty() ? 0 : (control.size() - 1) / static_cast<std::size_t>(degree);
  }
};

/// The pieces of a B-spline, one a knot span that is not empty, with (p - center) / size for its points p.
/// Exact: their control points are values of the span's polar form [Ramshaw 1989], so that any knots will do,
/// clamped or not.
BezierCurve to_bezier(const BSplineCurve& curve, const Point& center, double size);

/// The control points of pieces in one row: 3 floats a point, or 4 (w x, w y, w z, w) if rational.
std::vector<float> packed_control(const BezierCurve& curve, std::size_t first, std::size_t pieces);

/// A bound on the distance of a piece to its chord, from its second differences [Wang 1984]; for rational
/// pieces the differences of the projected points, times the square of the ratio of the weights.
double chord_error(const BezierCurve& curve, std::size_t piece);

/// Chords that keep within `tolerance` of a piece whose one chord keeps within `error`. 1 to 1024.
int chords(double error, double tolerance);

/// A chord that stands for consecutive pieces, all within `error` of it.
struct Chord {
  Point start, end;
  double error = 0;
};

/// Joins neighbours of a row of chords, each of which begins where the one before ends, while they stay
/// within `tolerance`; those whose own error is larger stay. Linear: each pass halves what it joins.
void join_chords(std::vector<Chord>& row, double tolerance);

}  // namespace meshcontour::detail
