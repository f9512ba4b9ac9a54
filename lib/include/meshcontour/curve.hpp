#pragma once

#include <cstddef>
#include <utility>
#include <variant>
#include <vector>

#include "meshcontour/types.hpp"

namespace meshcontour {

/// A straight line from start to end.
struct LineSegment {
  Point start = Point::Zero(), end = Point::Zero();
};

/// A circular arc, counter-clockwise about `axis` from start by `angle`; a full circle when angle is 2 pi,
/// then end == start.
struct CircularArc {
  Point start = Point::Zero(), end = Point::Zero();
  Point center = Point::Zero();
  Vector axis = Vector::UnitZ();  ///< of length 1
  double radius = 0;              ///< model units, positive
  double angle = 0;               ///< radians, in (0, 2 pi]
  bool full() const;
};

/// An elliptical arc: center + cos(t) major + sin(t) ratio (axis x major), t from start's parameter, growing
/// by `angle`.
struct EllipticalArc {
  Point start = Point::Zero(), end = Point::Zero();
  Point center = Point::Zero();
  Vector axis = Vector::UnitZ();   ///< of length 1
  Vector major = Vector::UnitX();  ///< the major half axis, length included, perpendicular to axis
  double ratio = 1;                ///< minor half axis / major half axis, in (0, 1]
  double angle = 0;                ///< radians of the ellipse's own parameter, in (0, 2 pi]
  bool full() const;
  Vector minor() const;            ///< the minor half axis, length included
  double start_parameter() const;  ///< t of `start`, radians in [0, 2 pi)
};

/// A B-spline curve, rational when `weights` is not empty.
///
/// C(u) = sum_i N_i(u) w_i P_i / sum_i N_i(u) w_i over [knots[degree], knots[control_points.size()]]
/// [Piegl & Tiller 1997, eqs. 2.5 and 4.1].
struct BSplineCurve {
  int degree = 3;
  std::vector<double> knots;          ///< control_points.size() + degree + 1, not decreasing
  std::vector<Point> control_points;  ///< when periodic the first `degree` are repeated at the end
  std::vector<double> weights;        ///< one a control point, positive; or empty
  bool periodic = false;              ///< the ends meet with the continuity of an inner knot

  std::pair<double, double> domain() const;
};

using Curve = std::variant<LineSegment, CircularArc, EllipticalArc, BSplineCurve>;

/// A piece of a contour between two vertices of its loop.
struct Segment {
  Index from = 0, to = 0;  ///< vertices of the shell at its ends; equal when it is the whole loop
  Curve curve;
  double deviation = 0;  ///< upper bound of its distance to the loop's chords and vertices, model units

  /// The edges of the shell that it runs along: edge .. edge + edge_count - 1, numbered from 0 within the
  /// shell. Segments of a shell along the same edges are the same curve, bit for bit, `reversed` where they
  /// run against its first use. Several edges: a full circle or ellipse that other patches see in parts.
  /// None: not known.
  Index edge = 0, edge_count = 0;
  bool reversed = false;
};

/// The curve of one boundary loop.
struct Contour {
  std::size_t shell = 0, patch = 0, loop = 0;  ///< indices from 0
  bool closed = true;
  std::vector<Segment> segments;  ///< joined end to start, in the direction of the loop
  double deviation = 0;           ///< the largest of its segments, model units
  bool fallback = false;          ///< could not be fitted: the segments are the loop's own polygon
};

/// Basis functions N_{span-degree..span} at u and their derivatives up to `order`, by the Cox-de Boor
/// recurrence [Piegl & Tiller 1997, A2.3]. The result has order+1 rows of degree+1 columns.
Eigen::MatrixXd basis_functions(const std::vector<double>& knots, int degree, std::size_t span, double u,
                                int order);

/// The knot span that holds u: the largest i in [degree, n-1] with knots[i] <= u and knots[i] < knots[i+1];
/// u outside the domain is clamped to it.
std::size_t find_span(const BSplineCurve& curve, double u);

/// Position at u, and derivatives up to `order` (row k: the k-th, as 3 coordinates), rational curves
/// included.
Point evaluate(const BSplineCurve& curve, double u);
Eigen::MatrixX3d derivatives(const BSplineCurve& curve, double u, int order);

/// Position at the fraction s in [0, 1] of a curve's own parameter.
Point evaluate(const Curve& curve, double s);

/// The curve as a clamped B-spline; arcs and ellipses become rational quadratics in pieces of at most 90
/// degrees [Piegl & Tiller 1997, section 7.3]; a periodic curve is clamped by knot insertion.
BSplineCurve to_clamped_bspline(const Curve& curve);

/// The same points, run backwards.
Curve reversed(const Curve& curve);

/// The curve after an affine map. Arcs stay arcs under similarity transforms, and become ellipses or rational
/// B-splines otherwise.
Curve transformed(const Curve& curve, const Eigen::Affine3d& placement);

/// Arc length, to a relative 1e-10.
double length(const Curve& curve);

}  // namespace meshcontour
