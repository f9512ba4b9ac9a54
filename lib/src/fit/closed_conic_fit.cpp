#include "fit/closed_conic_fit.hpp"

#include <algorithm>

#include "fit/arc_fit.hpp"
#include "fit/ellipse_fit.hpp"

namespace meshcontour::detail {
namespace {

constexpr double kScatter = 4;  // times the limit: what scatter of the points can make of equal axes

std::optional<ConicFit> circle_within(std::span<const Point> ring, double limit) {
  const std::optional<ArcFit> circle = fit_circle(ring, limit);
  if (!circle) return std::nullopt;
  return ConicFit{circle->arc, circle->residual};
}

}  // namespace

std::optional<ConicFit> fit_closed_conic(std::span<const Point> ring, double limit, double tolerance,
                                         std::size_t ellipse_points) {
  if (std::optional<ConicFit> circle = circle_within(ring, limit)) return circle;
  if (ring.size() < ellipse_points) return std::nullopt;
  const std::optional<EllipseFit> ellipse = fit_ellipse(ring, true, limit);
  if (!ellipse) return std::nullopt;
  if (ellipse->arc.major.norm() * (1 - ellipse->arc.ratio) <= kScatter * limit) {
    const double wider = std::min(tolerance, kScatter * limit);
    if (std::optional<ConicFit> circle = circle_within(ring, wider)) return circle;
  }
  return ConicFit{ellipse->arc, ellipse->residual};
}

}  // namespace meshcontour::detail
