#include "fit/closed_conics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

#include "fit/arc_fit.hpp"
#include "fit/closed_conic_fit.hpp"
#include "fit/ellipse_fit.hpp"

namespace meshcontour::detail {

namespace {

constexpr double kRungs[] = {1e-5, 1e-3, 1e-2, 0.1};  // of the tolerance
constexpr std::size_t kEllipsePoints = 12;

// The points of a closed loop, and how it turns.
struct Ring {
  std::vector<Point> points;
  double tolerance = 0, noise = 0;
  bool eligible = false;
};

double angle_between(const Vector& a, const Vector& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

// Every chain must have two chords, and no vertex may be a corner.
Ring ring_of(const Shell& shell, const BoundaryLoop& loop, std::span<const ChainUse> uses,
             const std::vector<RecognitionOptions>& settings, const ShellRecognition& recognition) {
  Ring ring;
  if (!loop.closed || uses.size() < 2 || loop.vertices.size() < 5) return ring;
  ring.tolerance = settings[uses[0].chain].tolerance;
  ring.noise = settings[uses[0].chain].noise;
  const double corner_angle = settings[uses[0].chain].corner_angle;
  for (const ChainUse& use : uses) {
    const Recognition& fit = recognition.fits[use.chain];
    if (fit.path.chords() < 2 || fit.pieces.size() > 2 || fit.pieces.front().chords() < 2) return ring;
    ring.tolerance = std::min(ring.tolerance, settings[use.chain].tolerance);
  }
  for (const Index v : loop.vertices) ring.points.push_back(shell.points[v] - shell.points[loop.vertices[0]]);
  const std::size_t n = ring.points.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vector before = ring.points[i] - ring.points[(i + n - 1) % n];
    const Vector after = ring.points[(i + 1) % n] - ring.points[i];
    if (!(angle_between(before, after) <= corner_angle)) return ring;
  }
  ring.eligible = true;
  return ring;
}

std::optional<ClosedConic> fit_ring(const Ring& ring) {
  for (const double share : kRungs) {
    const double eps = std::min(std::max(share * ring.tolerance, ring.noise), ring.tolerance);
    const auto conic = fit_closed_conic(ring.points, eps, ring.tolerance, kEllipsePoints);
    if (conic) return ClosedConic{0, 0, conic->curve, conic->residual};
  }
  return std::nullopt;
}

// Both ends of a part are held, as the segments beside it meet them: the circle gives way by as little as its
// ring is off them.
CircularArc part_of(const CircularArc& circle, const Vector& axis, const Point& start, const Point& end) {
  CircularArc arc = circle;
  const Vector along = (end - start).normalized();
  const Point middle = (start + end) / 2;
  arc.start = start;
  arc.end = end;
  arc.axis = (axis - axis.dot(along) * along).normalized();
  arc.center += (middle - arc.center).dot(along) * along;
  arc.center += (middle - arc.center).dot(arc.axis) * arc.axis;
  const Vector a = start - arc.center, b = end - arc.center;
  arc.radius = a.norm();
  arc.angle = std::atan2(a.cross(b).dot(arc.axis), a.dot(b));
  if (arc.angle <= 0) arc.angle += 2 * std::numbers::pi;
  return arc;
}

EllipticalArc part_of(const EllipticalArc& ellipse, const Vector& axis, const Point& start,
                      const Point& end) {
  EllipticalArc arc = ellipse;
  arc.axis = axis;
  arc.start = start;
  arc.end = end;
  hold_ends(arc);
  arc.angle = ellipse_parameter(arc, end) - ellipse_parameter(arc, start);
  if (arc.angle <= 0) arc.angle += 2 * std::numbers::pi;
  return arc;
}

double distance_to(const Curve& curve, const Point& point) {
  if (const auto* arc = std::get_if<CircularArc>(&curve)) return distance_to_circle(*arc, point);
  return distance_to_ellipse(std::get<EllipticalArc>(curve), point);
}

// Makes the whole chain an arc of the conic, whose centre is relative to `origin`, if its points are within
// the tolerance of that.
void make_part(const ClosedConic& conic, const Point& origin, double tolerance, const ChainUse& use,
               Recognition& fit) {
  const Path& path = fit.path;
  Piece piece{0, path.chords(), LineSegment{}, 0, true};
  std::visit(
      [&](auto whole) {
        if constexpr (requires { whole.center; }) {
          whole.center += origin - path.origin;
          const Vector axis = use.reversed ? Vector(-whole.axis) : whole.axis;
          piece.curve = part_of(whole, axis, path.points.front(), path.points.back());
        }
      },
      conic.curve);
  for (const Point& p : path.points) piece.residual = std::max(piece.residual, distance_to(piece.curve, p));
  if (piece.residual <= tolerance) fit.pieces = {piece};
}

bool is_arc_of_kind(const Recognition& fit, const ClosedConic& conic) {
  return fit.pieces.size() == 1 && fit.pieces[0].recognized &&
         fit.pieces[0].curve.index() == conic.curve.index();
}

}  // namespace

void find_closed_conics(const Shell& shell, const ShellBoundary& boundary,
                        const std::vector<RecognitionOptions>& settings, ShellRecognition& recognition) {
  recognition.conics.clear();
  for (std::size_t p = 0; p < boundary.patches.size(); ++p) {
    for (std::size_t l = 0; l < boundary.patches[p].loops.size(); ++l) {
      const BoundaryLoop& loop = boundary.patches[p].loops[l];
      const std::vector<ChainUse>& uses = recognition.chains.uses[p][l];
      const Ring ring = ring_of(shell, loop, uses, settings, recognition);
      if (!ring.eligible) continue;
      std::optional<ClosedConic> conic = fit_ring(ring);
      if (!conic) continue;
      conic->patch = p;
      conic->loop = l;
      const Point& origin = shell.points[loop.vertices[0]];
      for (const ChainUse& use : uses) {
        Recognition& fit = recognition.fits[use.chain];
        if (!is_arc_of_kind(fit, *conic)) make_part(*conic, origin, ring.tolerance, use, fit);
      }
      std::visit(
          [&](auto& whole) {
            if constexpr (requires { whole.center; }) {
              whole.center += origin;
              whole.start += origin;
              whole.end += origin;
            }
          },
          conic->curve);
      recognition.conics.push_back(std::move(*conic));
    }
  }
}

}  // namespace meshcontour::detail
