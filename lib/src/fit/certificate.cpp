#include "fit/certificate.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "fit/taylor_piece.hpp"
#include "model/segment_distance.hpp"

namespace meshcontour::detail {
namespace {

constexpr double kTightness = 1.02;  // a bound this close to a distance that the curve takes is not refined
constexpr int kMaxHalvings = 12;     // each takes the hull four times closer to the curve

struct Bound {
  double upper = 0;     // no point is farther
  double attained = 0;  // some point is as far
};

// The blossom of a cubic piece; `t` points at the knot that begins the span, `c` at the span's first control
// point.
Point cubic_blossom(const double* t, const Point* c, double a, double b, double e) {
  const auto mix = [](const Point& p, const Point& q, double low, double high, double u) -> Point {
    const double share = (u - low) / (high - low);
    return (1 - share) * p + share * q;
  };
  const Point p0 = mix(c[0], c[1], t[-2], t[1], a), p1 = mix(c[1], c[2], t[-1], t[2], a);
  const Point p2 = mix(c[2], c[3], t[0], t[3], a);
  return mix(mix(p0, p1, t[-1], t[1], b), mix(p1, p2, t[0], t[2], b), t[0], t[1], e);
}

std::array<CubicBezier, 2> halved(const CubicBezier& b) {
  const Point m01 = (b[0] + b[1]) / 2, m12 = (b[1] + b[2]) / 2, m23 = (b[2] + b[3]) / 2;
  const Point m012 = (m01 + m12) / 2, m123 = (m12 + m23) / 2, middle = (m012 + m123) / 2;
  return {CubicBezier{b[0], m01, m012, middle}, CubicBezier{middle, m123, m23, b[3]}};
}

Bound hull_bound(const CubicBezier& b, const Point& start, const Point& stop) {
  const double ends = std::max(segment_distance(b[0], start, stop), segment_distance(b[3], start, stop));
  const double inner = std::max(segment_distance(b[1], start, stop), segment_distance(b[2], start, stop));
  return {std::max(ends, inner), ends};
}

// Raises `bound` to that of one more Bezier piece, halving it where the hull is too far from the curve.
void add_piece(const CubicBezier& bezier, const Point& start, const Point& stop, double enough,
               Bound& bound) {
  struct Part {
    CubicBezier bezier;
    int depth;
  };
  std::array<Part, kMaxHalvings + 1> stack;
  std::size_t size = 0;
  stack[size++] = {bezier, 0};
  while (size > 0) {
    const Part part = stack[--size];
    const Bound hull = hull_bound(part.bezier, start, stop);
    bound.attained = std::max(bound.attained, hull.attained);
    const double good = std::max({enough, bound.upper, kTightness * bound.attained});
    if (hull.upper <= good || part.depth == kMaxHalvings) {
      bound.upper = std::max(bound.upper, hull.upper);
      continue;
    }
    const auto [left, right] = halved(part.bezier);
    stack[size++] = {right, part.depth + 1};
    stack[size++] = {left, part.depth + 1};
  }
}

// Cuts consecutive ranges of parameters at the knots, in constant time each.
class PieceWalk {
 public:
  explicit PieceWalk(const BSplineCurve& curve)
      : curve_(curve), period_(curve.domain().second - curve.domain().first) {}

  // Calls piece(span, begin, end) for the parts of [begin, end] in one span each, moved into the domain.
  template <typename Piece>
  void walk(double begin, double end, const Piece& piece) {
    const auto [low, high] = curve_.domain();
    double shift = begin >= high ? -period_ : begin < low ? period_ : 0;
    if (!curve_.periodic) shift = 0;
    double u = std::clamp(begin + shift, low, high), rest_end = std::max(end + shift, u);
    seek(u);
    while (true) {
      const bool wraps = curve_.periodic && rest_end > high;
      const double piece_end = std::min(curve_.knots[span_ + 1], wraps ? high : std::min(rest_end, high));
      piece(span_, u, piece_end);
      u = piece_end;
      if (!wraps && u >= std::min(rest_end, high)) return;
      if (u >= high) {
        u = low;
        rest_end -= period_;
      }
      seek(u);
    }
  }

 private:
  void seek(double u) {
    const std::size_t last = curve_.control_points.size() - 1;
    if (span_ == 0 || u < curve_.knots[span_]) span_ = find_span(curve_, u);
    while (span_ < last && curve_.knots[span_ + 1] <= u) ++span_;
  }

  const BSplineCurve& curve_;
  double period_;
  std::size_t span_ = 0;
};

// The chords of a run, each with its range of parameters.
struct Chords {
  std::span<const Point> points;
  std::span<const double> parameters;
  double period;  // 0: an open run

  std::size_t count() const { return period > 0 ? points.size() : points.size() - 1; }
  const Point& stop(std::size_t i) const { return points[i + 1 < points.size() ? i + 1 : 0]; }
  double end(std::size_t i) const {
    return i + 1 < points.size() ? parameters[i + 1] : parameters[0] + period;
  }
};

// A curve over h is nowhere farther than h^2/8 max |C''| from the line between its ends, nor these lines
// farther from a chord than their ends are. `attained` is raised to the largest distance of an end.
std::vector<double> quick_bounds(const BSplineCurve& curve, const Chords& chords, double& attained) {
  std::vector<double> bounds(chords.count(), 0.0);
  PieceWalk pieces(curve);
  std::size_t known = 0;
  TaylorPiece taylor;
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    const Point &start = chords.points[i], &stop = chords.stop(i);
    bool first = true;
    pieces.walk(chords.parameters[i], chords.end(i), [&](std::size_t span, double a, double b) {
      if (span != known)
        taylor = TaylorPiece(curve.knots.data() + span, curve.control_points.data() + span - 3);
      known = span;
      const double low = a - taylor.begin, high = b - taylor.begin;
      const Point begin = taylor.position(low);
      if (first) attained = std::max(attained, (begin - start).norm());
      first = false;
      const double ends = std::max(segment_distance(begin, start, stop),
                                   segment_distance(taylor.position(high), start, stop));
      const double acceleration = std::max(taylor.acceleration(low).norm(), taylor.acceleration(high).norm());
      attained = std::max(attained, ends);
      bounds[i] = std::max(bounds[i], ends + (b - a) * (b - a) / 8 * acceleration);
    });
  }
  return bounds;
}

}  // namespace

CubicBezier bezier_piece(const BSplineCurve& curve, std::size_t span, double begin, double end) {
  const double* t = curve.knots.data() + span;
  const Point* c = curve.control_points.data() + span - 3;
  return {cubic_blossom(t, c, begin, begin, begin), cubic_blossom(t, c, begin, begin, end),
          cubic_blossom(t, c, begin, end, end), cubic_blossom(t, c, end, end, end)};
}

double chord_deviation(const BSplineCurve& curve, double begin, double end, const Point& start,
                       const Point& stop, double enough) {
  Bound bound;
  PieceWalk(curve).walk(begin, end, [&](std::size_t span, double a, double b) {
    add_piece(bezier_piece(curve, span, a, b), start, stop, enough, bound);
  });
  return bound.upper;
}

double spline_deviation(const BSplineCurve& curve, std::span<const Point> points,
                        std::span<const double> parameters, bool closed) {
  const Chords chords{points, parameters, closed ? curve.domain().second - curve.domain().first : 0};
  Bound bound;
  const std::vector<double> quick = quick_bounds(curve, chords, bound.attained);
  if (!closed) {
    bound.attained = std::max(bound.attained, (points.back() - evaluate(curve, parameters.back())).norm());
  }
  bound.upper = bound.attained;
  // The worst chord first: most others are then known to be no worse.
  PieceWalk pieces(curve);
  const auto refine = [&](std::size_t i) {
    pieces.walk(parameters[i], chords.end(i), [&](std::size_t span, double a, double b) {
      add_piece(bezier_piece(curve, span, a, b), points[i], chords.stop(i), 0, bound);
    });
  };
  const auto worst = static_cast<std::size_t>(std::ranges::max_element(quick) - quick.begin());
  refine(worst);
  for (std::size_t i = 0; i < quick.size(); ++i) {
    if (i == worst || quick[i] <= bound.upper) continue;
    if (quick[i] <= kTightness * bound.attained) {
      bound.upper = quick[i];
    } else {
      refine(i);
    }
  }
  return bound.upper;
}

double line_deviation(const LineSegment& line, std::span<const Point> points) {
  double deviation = std::max((line.start - points.front()).norm(), (line.end - points.back()).norm());
  for (const Point& p : points) deviation = std::max(deviation, segment_distance(p, line.start, line.end));
  return deviation;
}

double arc_deviation(const CircularArc& arc, std::span<const Point> points) {
  constexpr double kWindingSlack = 0.1;  // radians
  const auto radial = [&](const Point& p) -> Vector {
    const Vector v = p - arc.center;
    return v - v.dot(arc.axis) * arc.axis;
  };
  double residual = 0, step = 0, turned = 0, farthest = 0;
  const auto add_step = [&](const Vector& from, const Vector& to) {
    const double angle = std::atan2(from.cross(to).dot(arc.axis), from.dot(to));
    turned += angle;
    step = std::max(step, std::abs(angle));
  };
  Vector previous = radial(arc.start);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector v = points[i] - arc.center;
    const bool first = i == 0, last = !arc.full() && i + 1 == points.size();
    const Vector current = first && !arc.full() ? previous : last ? radial(arc.end) : radial(points[i]);
    const double height = v.dot(arc.axis);
    residual = std::max(residual, std::hypot(radial(points[i]).norm() - arc.radius, height));
    farthest = std::max(farthest, v.norm());
    add_step(previous, current);
    previous = current;
  }
  if (arc.full()) {
    add_step(previous, radial(arc.start));
  } else {
    residual = std::max({residual, (arc.start - points.front()).norm(), (arc.end - points.back()).norm()});
  }
  if (std::abs(turned - arc.angle) > kWindingSlack) return farthest + arc.radius;
  return residual + arc.radius * (1 - std::cos(step / 2));
}

}  // namespace meshcontour::detail
