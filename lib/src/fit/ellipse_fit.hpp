#pragma once

#include <optional>
#include <span>

#include "meshcontour/curve.hpp"

namespace meshcontour::detail {

/// An elliptical arc and the largest distance of the fitted points to it.
struct EllipseFit {
  EllipticalArc arc;
  double residual = 0;
};

/// The ellipse nearest to points in one plane: direct least squares [Halir & Flusser 1998], then Gauss-Newton
/// on the distance. Open: from the first to the last point, both held exactly. Nothing if a point is farther
/// than `limit`, the points do not run one way around it in steps of at most 60 degrees, or an axis is 200
/// times the other. O(N).
///
/// @param points  N >= 6; closed: the first point not repeated.
std::optional<EllipseFit> fit_ellipse(std::span<const Point> points, bool closed, double limit);

/// Moves the ellipse by the small similarity that makes it run through `start` and `end`; `angle` is left as
/// it is.
void hold_ends(EllipticalArc& arc);

/// The ellipse's own parameter of the nearest point, in (-pi, pi].
double ellipse_parameter(const EllipticalArc& arc, const Point& point);

/// Distance of a point to the ellipse that carries the arc.
double distance_to_ellipse(const EllipticalArc& arc, const Point& point);

/// An upper bound of the distance between the arc and the chords of points within `residual` of it.
double ellipse_deviation(const EllipticalArc& arc, std::span<const Point> points, double residual);

}  // namespace meshcontour::detail
