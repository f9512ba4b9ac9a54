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

// The control point of the cubic spline whose three knots are the one with this position and slope and its
// neighbours: the blossom there, from the second derivative.
Point control_point(const Point& position, const Vector& slope, const Vector& second, double before,
                    double after) {
  return position + (after - before) / 3 * slope - before * after / 6 * second;
}

// Second derivative at the start of a cubic Hermite piece.
Vector second_derivative(const Vector& chord, const Vector& slope, const Vector& next_slope, double step) {
  return (6 * chord - 4 * slope - 2 * next_slope) / step;
}

// Derivative at the first parameter of the polynomial through up to four points, by divided differences.
Vector end_slope(std::span<const Point> points, std::span<const double> t) {
  const std::size_t count = std::min<std::size_t>(4, points.size());
  std::array<Vector, 4> difference;
  for (std::size_t i = 0; i < count; ++i) difference[i] = points[i];
  Vector slope = Vector::Zero();
  double factor = 1;
  for (std::size_t order = 1; order < count; ++order) {
    for (std::size_t i = 0; i + order < count; ++i) {
      difference[i] = (difference[i + 1] - difference[i]) / (t[i + order] - t[i]);
    }
    slope += factor * difference[0];
    factor *= t[0] - t[order];
  }
  return slope;
}

// The same at the last parameter.
Vector last_slope(std::span<const Point> points, std::span<const double> t) {
  const std::size_t count = std::min<std::size_t>(4, points.size());
  const std::vector<Point> reversed_points(points.rbegin(),
                                           points.rbegin() + static_cast<std::ptrdiff_t>(count));
  const std::vector<double> reversed_t(t.rbegin(), t.rbegin() + static_cast<std::ptrdiff_t>(count));
  return end_slope(reversed_points, reversed_t);
}

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
  const std::size_t n = points.size();
  const std::vector<double> t = chord_length_parameters(points, true);
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
    const std::size_t i = (k + n - 1) % n;
    const Vector second = second_derivative(chord(i), slopes[i], slopes[(i + 1) % n], step(i));
    result.curve.control_points.push_back(
        control_point(points[i], slopes[i], second, step((i + n - 1) % n), step(i)));
  }
  return result;
}

ParametrizedCurve open_interpolation(std::span<const Point> points) {
  const std::size_t n = points.size();
  ParametrizedCurve result;
  std::vector<double>& t = result.parameters;
  t = chord_length_parameters(points, false);
  const auto step = [&](std::size_t i) { return t[i + 1] - t[i]; };
  const auto chord = [&](std::size_t i) -> Vector { return (points[i + 1] - points[i]) / step(i); };
  SlopeSystem system;
  system.resize(n);
  system.right[0] = end_slope(points, t);
  system.right[n - 1] = last_slope(points, t);
  for (std::size_t i = 1; i + 1 < n; ++i) system.set_row(i, step(i - 1), step(i), chord(i - 1), chord(i));
  const std::vector<Vector> slopes = system.solve_open();
  result.curve.knots = clamped_knots(t);
  result.curve.control_points.reserve(n + 2);
  result.curve.control_points.push_back(points.front());
  for (std::size_t i = 0; i < n; ++i) {
    const bool last = i + 1 == n;
    const Vector second =
        last ? Vector::Zero() : second_derivative(chord(i), slopes[i], slopes[i + 1], step(i));
    result.curve.control_points.push_back(
        control_point(points[i], slopes[i], second, i == 0 ? 0 : step(i - 1), last ? 0 : step(i)));
  }
  result.curve.control_points.push_back(points.back());
  return result;
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
