#pragma once

// Curves for tests, and oracles that share no code with the library.

#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include "meshcontour/curve.hpp"

namespace meshcontour::test {

/// A number in [low, high) from the engine's own bits: the same on every platform.
inline double uniform(std::mt19937& engine, double low, double high) {
  return low + (high - low) * (static_cast<double>(engine()) / 4294967296.0);
}

inline Point random_point(std::mt19937& engine, double size = 1) {
  const double x = uniform(engine, -size, size), y = uniform(engine, -size, size);
  return {x, y, uniform(engine, -size, size)};
}

/// A basis function straight from the recursive definition [de Boor 1978], closed at the right end of the
/// domain.
inline double basis_by_definition(const std::vector<double>& knots, int degree, std::size_t i, double u,
                                  double end) {
  if (degree == 0)
    return knots[i] < knots[i + 1] && u >= knots[i] &&
           (u < knots[i + 1] || (u == end && knots[i + 1] == end));
  const auto p = static_cast<std::size_t>(degree);
  double sum = 0;
  if (knots[i + p] > knots[i]) {
    sum += (u - knots[i]) / (knots[i + p] - knots[i]) * basis_by_definition(knots, degree - 1, i, u, end);
  }
  if (knots[i + p + 1] > knots[i + 1]) {
    sum += (knots[i + p + 1] - u) / (knots[i + p + 1] - knots[i + 1]) *
           basis_by_definition(knots, degree - 1, i + 1, u, end);
  }
  return sum;
}

/// A position as the plain sum over all control points; small curves only.
inline Point position_by_definition(const BSplineCurve& curve, double u) {
  Point sum = Point::Zero();
  double weight_sum = 0;
  for (std::size_t i = 0; i < curve.control_points.size(); ++i) {
    const double weight = curve.weights.empty() ? 1 : curve.weights[i];
    const double basis = basis_by_definition(curve.knots, curve.degree, i, u, curve.domain().second);
    sum += basis * weight * curve.control_points[i];
    weight_sum += basis * weight;
  }
  return sum / weight_sum;
}

/// A curve with uneven inner knots; clamped, or with knots that run beyond the domain.
inline BSplineCurve random_curve(std::mt19937& engine, int degree, std::size_t count, bool clamped,
                                 bool rational) {
  BSplineCurve curve;
  curve.degree = degree;
  const auto p = static_cast<std::size_t>(degree);
  double knot = uniform(engine, -2, 2);
  for (std::size_t i = 0; i < count + p + 1; ++i) {
    const bool inside = i > p && i <= count;
    if (inside || (!clamped && i > 0)) knot += uniform(engine, 0.1, 1.5);
    curve.knots.push_back(knot);
  }
  for (std::size_t i = 0; i < count; ++i) {
    curve.control_points.push_back(random_point(engine, 10));
    if (rational) curve.weights.push_back(uniform(engine, 0.3, 3));
  }
  return curve;
}

/// A closed cubic with uneven periodic knots through no point in particular.
inline BSplineCurve random_periodic(std::mt19937& engine, std::size_t count) {
  BSplineCurve curve;
  curve.periodic = true;
  std::vector<double> steps;
  for (std::size_t i = 0; i < count; ++i) {
    steps.push_back(uniform(engine, 0.2, 1.5));
    curve.control_points.push_back(random_point(engine, 10));
  }
  double knot = 0;
  for (std::size_t i = 0; i < count + 7; ++i) {
    curve.knots.push_back(knot);
    knot += steps[i % count];
  }
  for (std::size_t i = 0; i < 3; ++i) curve.control_points.push_back(curve.control_points[i]);
  return curve;
}

/// Distance of a point and a line segment.
inline double segment_distance(const Point& p, const Point& a, const Point& b) {
  const Vector along = b - a;
  const double squared = along.squaredNorm();
  const double s = squared > 0 ? std::min(1.0, std::max(0.0, (p - a).dot(along) / squared)) : 0;
  return (p - a - s * along).norm();
}

}  // namespace meshcontour::test
