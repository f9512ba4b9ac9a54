#pragma once

// Proven upper bounds of the distance between a curve and the chords of its loop. Nothing here is sampled.

#include <array>
#include <span>

#include "meshcontour/curve.hpp"

namespace meshcontour::detail {

/// A cubic polynomial piece by its Bezier points.
using CubicBezier = std::array<Point, 4>;

/// The piece of a cubic without weights over [begin, end], which must lie in one knot span; by blossoms.
CubicBezier bezier_piece(const BSplineCurve& curve, std::size_t span, double begin, double end);

/// Bound of the distance of the curve over [begin, end] to the segment: the distance to a convex set is a
/// convex function, so that no point of a Bezier piece is farther than its farthest Bezier point. Pieces are
/// halved until the bound is at most `enough`, or within 2 % of a distance that the curve takes.
///
/// @param curve  cubic, without weights.
/// @param begin  in the curve's domain, as is end; begin <= end. Of a periodic curve both may lie a period
/// outside.
double chord_deviation(const BSplineCurve& curve, double begin, double end, const Point& start,
                       const Point& stop, double enough = 0);

/// Bound of the Hausdorff distance between a cubic and the chords of its points, parameters[i] belonging to
/// points[i]. In a closed loop the last chord runs back to points[0], at parameters[0] plus the period.
///
/// Both directions: a piece of curve within H of its chord, its ends within e of the chord's, passes within
/// max(H, e) of every point of the chord, since its projection to the chord is connected.
///
/// @param curve  cubic, without weights; periodic if closed.
double spline_deviation(const BSplineCurve& curve, std::span<const Point> points,
                        std::span<const double> parameters, bool closed);

/// The same for a line: the projection of the points to it covers it, so that the points' distance is the
/// bound.
double line_deviation(const LineSegment& line, std::span<const Point> points);

/// The same for an arc that the points run along: the largest distance of a point to the circle, plus the
/// sagitta of the largest step between neighbours.
///
/// @param points  from arc.start to arc.end; of a full circle each once, and the last step runs back to the
/// first.
double arc_deviation(const CircularArc& arc, std::span<const Point> points);

}  // namespace meshcontour::detail
