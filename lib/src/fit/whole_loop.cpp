#include "fit/whole_loop.hpp"

#include <algorithm>

#include "meshcontour/fit.hpp"

namespace meshcontour::detail {
namespace {

std::vector<double> uniform_knots(std::size_t count) {
  std::vector<double> knots(count);
  for (std::size_t i = 0; i < count; ++i) knots[i] = static_cast<double>(i);
  return knots;
}

// Parameters of the points, 0 and then the chord lengths added up; closed: the first point's again at the
// end.
std::vector<double> chord_length_parameters(std::span<const Point> points, bool closed) {
  std::vector<double> t{0};
  t.reserve(points.size() + 1);
  for (std::size_t i = 1; i < points.size(); ++i) t.push_back(t.back() + (points[i] - points[i - 1]).norm());
  if (closed) t.push_back(t.back() + (points.front() - points.back()).norm());
  return t;
}

// The tridiagonal system of the slopes of a cubic spline at its knots.
struct SlopeSystem {
  std::vector<double> lower, diagonal, upper;  // row i: slopes i - 1, i, i + 1
  std::vector<Vector> right;

  void resize(std::size_t n) {
    lower.assign(n, 0);
    diagonal.assign(n, 1);
    upper.assign(n, 0);
    right.assign(n, Vector::Zero());
  }

  // Continuity of the second derivative at a knot with the steps `before` and `after` and the slopes of the
  // chords.
  void set_row(std::size_t i, double before, double after, const Vector& chord_before,
               const Vector& chord_after) {
    const double scale = 1 / (before + after);
    lower[i] = after * scale;
    diagonal[i] = 2;
    upper[i] = before * scale;
    right[i] = 3 * scale * (after * chord_before + before * chord_after);
  }

  // Rows first..last - 1 alone, `column` being a second right-hand side; both are overwritten by the
  // solutions.
  void solve(std::size_t last, std::vector<double>& column) {
    for (std::size_t i = 1; i < last; ++i) {
      const double factor = lower[i] / diagonal[i - 1];
      diagonal[i] -= factor * upper[i - 1];
      right[i] -= factor * right[i - 1];
      column[i] -= factor * column[i - 1];
    }
    for (std::size_t i = last; i-- > 0;) {
      if (i + 1 < last) {
        right[i] -= upper[i] * right[i + 1];
        column[i] -= upper[i] * column[i + 1];
      }
      right[i] /= diagonal[i];
      column[i] /= diagonal[i];
    }
  }

  // The third derivative is continuous at the second knot, or the last but one: the steps next to the end and
  // beyond, and the slopes of their chords.
  void set_end_row(std::size_t i, double step, double beyond, const Vector& chord,
                   const Vector& chord_beyond) {
    const double both = step + beyond, scale = 1 / both;
    diagonal[i] = beyond * scale;
    (i == 0 ? upper : lower)[i] = 1;
    right[i] = scale * scale * ((step + 2 * both) * beyond * chord + step * step * chord_beyond);
  }

  // The slopes of an open chain.
  std::vector<Vector> solve_open() {
    std::vector<double> unused(right.size(), 0);
    solve(right.size(), unused);
    return std::move(right);
  }

  // The slopes of a closed loop: all but the last in terms of the last, which its own row then gives.
  std::vector<Vector> solve_closed() {
    const std::size_t last = right.size() - 1;
    std::vector<double> column(last, 0);
    column[0] = -lower[0];
    column[last - 1] -= upper[last - 1];
    const double low = lower[last], middle = diagonal[last], up = upper[last];
    const Vector rest = right[last];
    solve(last, column);
    const Vector value =
        (rest - low * right[last - 1] - up * right[0]) / (middle + low * column[last - 1] + up * column[0]);
    for (std::size_t i = 0; i < last; ++i) right[i] += column[i] * value;
    right[last] = value;
    return std::move(right);
  }
};

// A cubic by its Taylor coefficients at the start of a step.
struct HermitePiece {
  Point position;
  Vector first, second, third;  // the derivatives over 1, 2 and 6

  HermitePiece(const Point& start, const Point& end, const Vector& slope, const Vector& end_slope,
               double step)
      : position(start), first(slope) {
    const Vector chord = (end - start) / step;
    second = (3 * chord - 2 * slope - end_slope) / step;
    third = (slope + end_slope - 2 * chord) / (step * step);
  }

  // The blossom at three parameters, counted from the start.
  Point blossom(double a, double b, double c) const {
    return position + (a + b + c) / 3 * first + (a * b + a * c + b * c) / 3 * second + a * b * c * third;
  }
};

std::vector<double> clamped_knots(std::span<const double> t) {
  std::vector<double> knots(3, t.front());
  knots.insert(knots.end(), t.begin(), t.end());
  knots.insert(knots.end(), 3, t.back());
  return knots;
}

// Knots t[-3] .. t[n + 3] of a loop with parameters t[0] .. t[n].
std::vector<double> periodic_knots(std::span<const double> t) {
  const std::size_t n = t.size() - 1;
  const double period = t[n];
  std::vector<double> knots;
  knots.reserve(n + 7);
  for (std::size_t k = 3; k > 0; --k) knots.push_back(t[n - k] - period);
  knots.insert(knots.end(), t.begin(), t.end());
  for (std::size_t k = 1; k <= 3; ++k) knots.push_back(t[k] + period);
  return knots;
}

ParametrizedCurve interpolate_loop(std::span<const Point> points, std::span<const double> t) {
  const std::size_t n = points.size();
  const auto step = [&](std::size_t i) { return t[i + 1] - t[i]; };
  const auto chord = [&](std::size_t i) -> Vector { return (points[(i + 1) % n] - points[i]) / step(i); };
  SlopeSystem system;
  system.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t before = (i + n - 1) % n;
    system.set_row(i, step(before), step(i), chord(before), chord(i));
  }
  const std::vector<Vector> slopes = system.solve_closed();
  ParametrizedCurve result;
  result.curve.periodic = true;
  result.curve.knots = periodic_knots(t);
  result.parameters.assign(t.begin(), t.end() - 1);
  result.curve.control_points.reserve(n + 3);
  for (std::size_t k = 0; k < n + 3; ++k) {  // control point k has its middle knot at point k - 1
    const std::size_t i = (k + n - 1) % n, next = (i + 1) % n;
    const HermitePiece piece(points[i], points[next], slopes[i], slopes[next], step(i));
    result.curve.control_points.push_back(piece.blossom(-step((i + n - 1) % n), 0, step(i)));
  }
  return result;
}

// The slopes at the knots of the spline through an open chain.
std::vector<Vector> chain_slopes(std::span<const Point> points, std::span<const double> t) {
  const std::size_t n = points.size();
  const auto step = [&](std::size_t i) { return t[i + 1] - t[i]; };
  const auto chord = [&](std::size_t i) -> Vector { return (points[i + 1] - points[i]) / step(i); };
  if (n == 2) return {chord(0), chord(0)};
  if (n == 3) {
    const Vector middle = (step(1) * chord(0) + step(0) * chord(1)) / (step(0) + step(1));
    return {2 * chord(0) - middle, middle, 2 * chord(1) - middle};
  }
  SlopeSystem system;
  system.resize(n);
  system.set_end_row(0, step(0), step(1), chord(0), chord(1));
  for (std::size_t i = 1; i + 1 < n; ++i) system.set_row(i, step(i - 1), step(i), chord(i - 1), chord(i));
  system.set_end_row(n - 1, step(n - 2), step(n - 3), chord(n - 2), chord(n - 3));
  return system.solve_open();
}

ParametrizedCurve interpolate_chain(std::span<const Point> points, std::span<const double> t) {
  const std::size_t n = points.size();
  const std::vector<Vector> slopes = chain_slopes(points, t);
  std::vector<double> breaks{t.front()};
  if (n > 4) breaks.insert(breaks.end(), t.begin() + 2, t.end() - 2);
  breaks.push_back(t.back());
  ParametrizedCurve result;
  result.parameters.assign(t.begin(), t.end());
  result.curve.knots = clamped_knots(breaks);
  const std::vector<double>& knots = result.curve.knots;
  result.curve.control_points.push_back(points.front());
  for (std::size_t k = 1; k + 5 < knots.size(); ++k) {  // at a point near the middle knot
    const std::size_t i = n < 4 ? 0 : std::clamp<std::size_t>(k, 1, n - 2);
    const HermitePiece piece(points[i], points[i + 1], slopes[i], slopes[i + 1], t[i + 1] - t[i]);
    result.curve.control_points.push_back(
        piece.blossom(knots[k + 1] - t[i], knots[k + 2] - t[i], knots[k + 3] - t[i]));
  }
  result.curve.control_points.push_back(points.back());
  return result;
}

}  // namespace

ParametrizedCurve closed_control_curve(std::span<const Point> points) {
  ParametrizedCurve result;
  result.curve.periodic = true;
  result.curve.control_points.assign(points.begin(), points.end());
  result.curve.control_points.insert(result.curve.control_points.end(), points.begin(), points.begin() + 3);
  result.curve.knots = uniform_knots(points.size() + 7);
  // Basis function i has its peak at knot i + 2.
  for (std::size_t i = 0; i < points.size(); ++i) result.parameters.push_back(static_cast<double>(i + 2));
  return result;
}

ParametrizedCurve open_control_curve(std::span<const Point> points) {
  ParametrizedCurve result;
  BSplineCurve& curve = result.curve;
  curve.control_points.assign(points.begin(), points.end());
  if (points.size() == 2) {
    curve.control_points = {points[0], (2 * points[0] + points[1]) / 3, (points[0] + 2 * points[1]) / 3,
                            points[1]};
    result.parameters = {0, 1};
  } else if (points.size() == 3) {
    curve.control_points = {points[0], (points[0] + 2 * points[1]) / 3, (2 * points[1] + points[2]) / 3,
                            points[2]};
    result.parameters = {0, 0.5, 1};
  }
  curve.knots = clamped_knots(uniform_knots(curve.control_points.size() - 2));
  for (std::size_t i = result.parameters.size(); i < points.size(); ++i) {  // Greville abscissae
    result.parameters.push_back((curve.knots[i + 1] + curve.knots[i + 2] + curve.knots[i + 3]) / 3);
  }
  return result;
}

ParametrizedCurve closed_interpolation(std::span<const Point> points) {
  return interpolation(points, chord_length_parameters(points, true), true);
}

ParametrizedCurve open_interpolation(std::span<const Point> points) {
  return interpolation(points, chord_length_parameters(points, false), false);
}

ParametrizedCurve interpolation(std::span<const Point> points, std::span<const double> parameters,
                                bool closed) {
  return closed ? interpolate_loop(points, parameters) : interpolate_chain(points, parameters);
}

}  // namespace meshcontour::detail

namespace meshcontour {

BSplineCurve control_polygon_curve(std::span<const Point> points) {
  return detail::closed_control_curve(points).curve;
}

BSplineCurve interpolate_closed(std::span<const Point> points) {
  return detail::closed_interpolation(points).curve;
}

}  // namespace meshcontour
