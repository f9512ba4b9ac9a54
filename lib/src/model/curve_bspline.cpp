// Basis functions, positions and derivatives of B-spline curves.

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <vector>

#include "meshcontour/curve.hpp"
#include "model/blossom.hpp"

namespace meshcontour {
namespace {

// Row r: the non-zero basis functions of degree r below the diagonal, the knot differences above it
// [Piegl & Tiller 1997, p. 71].
Eigen::MatrixXd basis_triangle(const std::vector<double>& knots, int degree, std::size_t span, double u) {
  Eigen::MatrixXd triangle = Eigen::MatrixXd::Zero(degree + 1, degree + 1);
  triangle(0, 0) = 1;
  for (int j = 1; j <= degree; ++j) {
    double saved = 0;
    for (int r = 0; r < j; ++r) {
      const double right = knots[span + static_cast<std::size_t>(r) + 1] - u;
      const double left = u - knots[span + 1 - static_cast<std::size_t>(j - r)];
      triangle(j, r) = right + left;
      const double share = triangle(r, j - 1) / triangle(j, r);
      triangle(r, j) = saved + right * share;
      saved = left * share;
    }
    triangle(j, j) = saved;
  }
  return triangle;
}

// The derivatives of the r-th non-zero basis function [Piegl & Tiller 1997, eq. 2.10], without the
// factorials.
void basis_derivatives(const Eigen::MatrixXd& triangle, int r, Eigen::MatrixXd& result) {
  const int degree = static_cast<int>(triangle.rows()) - 1;
  Eigen::VectorXd previous = Eigen::VectorXd::Zero(degree + 1), current = previous;
  previous(0) = 1;
  for (int k = 1; k <= std::min<int>(degree, static_cast<int>(result.rows()) - 1); ++k) {
    const int lower_degree = degree - k;
    double sum = 0;
    for (int j = std::max(0, k - r); j <= std::min(k, degree - r); ++j) {
      const int index = r - k + j;
      const double above = j < k ? previous(j) : 0, below = j > 0 ? previous(j - 1) : 0;
      current(j) = (above - below) / triangle(lower_degree + 1, index);
      sum += current(j) * triangle(index, lower_degree);
    }
    result(k, r) = sum;
    std::swap(previous, current);
    current.setZero();
  }
}

double binomial(int n, int k) {
  double value = 1;
  for (int i = 1; i <= k; ++i) value = value * (n - k + i) / i;
  return value;
}

// Homogeneous derivatives to those of the curve [Piegl & Tiller 1997, eq. 4.8].
Eigen::MatrixX3d projected(const Eigen::MatrixX4d& homogeneous) {
  Eigen::MatrixX3d result(homogeneous.rows(), 3);
  for (int k = 0; k < homogeneous.rows(); ++k) {
    Eigen::RowVector3d value = homogeneous.row(k).head<3>();
    for (int i = 1; i <= k; ++i) value -= binomial(k, i) * homogeneous(i, 3) * result.row(k - i);
    result.row(k) = value / homogeneous(0, 3);
  }
  return result;
}

}  // namespace

Eigen::MatrixXd basis_functions(const std::vector<double>& knots, int degree, std::size_t span, double u,
                                int order) {
  const Eigen::MatrixXd triangle = basis_triangle(knots, degree, span, u);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(order + 1, degree + 1);
  for (int r = 0; r <= degree; ++r) {
    result(0, r) = triangle(r, degree);
    basis_derivatives(triangle, r, result);
  }
  double factor = degree;
  for (int k = 1; k <= std::min(order, degree); ++k) {
    result.row(k) *= factor;
    factor *= degree - k;
  }
  return result;
}

std::size_t find_span(const BSplineCurve& curve, double u) {
  const auto first = curve.knots.begin() + curve.degree;
  const auto last = curve.knots.begin() + static_cast<std::ptrdiff_t>(curve.control_points.size());
  u = std::clamp(u, *first, *last);
  // At the end of the domain, the last span that is not empty.
  const auto above = u < *last ? std::upper_bound(first, last, u) : std::lower_bound(first, last, u);
  return static_cast<std::size_t>(std::max(above - 1, first) - curve.knots.begin());
}

Point evaluate(const BSplineCurve& curve, double u) {
  const auto [begin, end] = curve.domain();
  const double inside = std::clamp(u, begin, end);
  return detail::projected(curve,
                           detail::blossom(curve, find_span(curve, inside), [&](int) { return inside; }));
}

Eigen::MatrixX3d derivatives(const BSplineCurve& curve, double u, int order) {
  const auto [begin, end] = curve.domain();
  u = std::clamp(u, begin, end);
  const std::size_t span = find_span(curve, u);
  const Eigen::MatrixXd basis = basis_functions(curve.knots, curve.degree, span, u, order);
  Eigen::MatrixX4d homogeneous = Eigen::MatrixX4d::Zero(order + 1, 4);
  for (int r = 0; r <= curve.degree; ++r) {
    const std::size_t i = span - static_cast<std::size_t>(curve.degree - r);
    homogeneous += basis.col(r) * detail::homogeneous_point(curve, i).transpose();
  }
  Eigen::MatrixX3d result =
      curve.weights.empty() ? Eigen::MatrixX3d(homogeneous.leftCols<3>()) : projected(homogeneous);
  result.row(0) = evaluate(curve, u).transpose();
  return result;
}

}  // namespace meshcontour
