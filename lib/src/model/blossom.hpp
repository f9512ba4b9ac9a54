#pragma once

// The polar form of a piece of a B-spline curve: evaluation, knot insertion and Bezier points are all values
// of it.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "meshcontour/curve.hpp"

namespace meshcontour::detail {

/// Control point i as (w x, w y, w z, w); w is 1 for a curve without weights.
inline Eigen::Vector4d homogeneous_point(const BSplineCurve& curve, std::size_t i) {
  const double weight = curve.weights.empty() ? 1 : curve.weights[i];
  Eigen::Vector4d result;
  result << weight * curve.control_points[i], weight;
  return result;
}

/// The point that a homogeneous one stands for.
inline Point projected(const BSplineCurve& curve, const Eigen::Vector4d& p) {
  return curve.weights.empty() ? Point(p.head<3>()) : Point(p.head<3>() / p[3]);
}

/// The blossom of the polynomial piece on [knots[span], knots[span + 1]] at the arguments
/// argument(1..degree), by de Boor's recurrence [Piegl & Tiller 1997, A5.1; Ramshaw 1989]. Exact where
/// arguments are knots of the piece in ascending order.
template <typename Argument>
Eigen::Vector4d blossom(const BSplineCurve& curve, std::size_t span, const Argument& argument) {
  constexpr std::size_t kUsualDegree = 7;
  const auto degree = static_cast<std::size_t>(curve.degree);
  std::array<Eigen::Vector4d, kUsualDegree + 1> fixed;
  std::vector<Eigen::Vector4d> heap(degree > kUsualDegree ? degree + 1 : 0);
  Eigen::Vector4d* points = heap.empty() ? fixed.data() : heap.data();
  for (std::size_t j = 0; j <= degree; ++j) points[j] = homogeneous_point(curve, span - degree + j);
  for (std::size_t r = 1; r <= degree; ++r) {
    const double u = argument(static_cast<int>(r));
    for (std::size_t j = degree; j >= r; --j) {
      const double low = curve.knots[span - degree + j];
      const double high = curve.knots[span + j + 1 - r];
      const double share = (u - low) / (high - low);
      points[j] = (1 - share) * points[j - 1] + share * points[j];
    }
  }
  return points[degree];
}

}  // namespace meshcontour::detail
