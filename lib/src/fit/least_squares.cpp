#include "fit/least_squares.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

namespace meshcontour::detail {
namespace {

constexpr double kSmallestPivot = 1e-13;  // relative to the diagonal before elimination

// The four cubics that are not zero in one span, by Cox-de Boor with the divisions done once a span.
class SpanBasis {
 public:
  /// @param t  points at the knot that begins the span; t[-2] .. t[3] are used.
  explicit SpanBasis(const double* t)
      : low2_(t[-2]),
        low1_(t[-1]),
        low_(t[0]),
        high_(t[1]),
        high1_(t[2]),
        high2_(t[3]),
        over1_(1 / (high_ - low_)),
        over2_{1 / (high_ - low1_), 1 / (high1_ - low_)},
        over3_{1 / (high_ - low2_), 1 / (high1_ - low1_), 1 / (high2_ - low_)} {}

  std::array<double, 4> operator()(double u) const {
    const double b1 = (u - low_) * over1_, b0 = (high_ - u) * over1_;
    const double x = b0 * over2_[0], y = b1 * over2_[1];
    const double c0 = (high_ - u) * x, c1 = (u - low1_) * x + (high1_ - u) * y, c2 = (u - low_) * y;
    const double p = c0 * over3_[0], q = c1 * over3_[1], r = c2 * over3_[2];
    return {(high_ - u) * p, (u - low2_) * p + (high1_ - u) * q, (u - low1_) * q + (high2_ - u) * r,
            (u - low_) * r};
  }

 private:
  double low2_, low1_, low_, high_, high1_, high2_;
  double over1_;
  std::array<double, 2> over2_;
  std::array<double, 3> over3_;
};

// The share of one span in the normal equations.
struct SpanSums {
  std::array<std::array<double, 4>, 4> products{};  // [a][b - a]
  std::array<Vector, 4> right{Vector::Zero(), Vector::Zero(), Vector::Zero(), Vector::Zero()};

  void add(const std::array<double, 4>& basis, const Point& p, double weight) {
    for (std::size_t a = 0; a < 4; ++a) {
      const double weighted = weight * basis[a];
      for (std::size_t b = a; b < 4; ++b) products[a][b - a] += weighted * basis[b];
      right[a] += weighted * p;
    }
  }
};

}  // namespace

void CubicLeastSquares::assemble(std::size_t unknowns, std::span<const double> knots,
                                 std::span<const Point> points, std::span<const double> parameters) {
  rows_.assign(unknowns, Row{});
  right_.assign(unknowns, Vector::Zero());
  const double* t = knots.data() + 3;
  const std::size_t spans = knots.size() - 7;
  const double begin = t[0], end = t[spans];
  const auto add_span = [&](std::size_t span, const SpanSums& sums) {
    for (std::size_t a = 0; a < 4; ++a) {
      const std::size_t i = span + a < unknowns ? span + a : span + a - unknowns;
      for (std::size_t d = 0; d + a < 4; ++d) rows_[i][d] += sums.products[a][d];
      right_[i] += sums.right[a];
    }
  };
  std::size_t span = 0;
  SpanBasis basis(t);
  SpanSums sums;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double u = parameters[i] < begin ? parameters[i] + (end - begin)
                     : parameters[i] > end ? parameters[i] - (end - begin)
                                           : parameters[i];
    if (u < t[span] || (u >= t[span + 1] && span + 1 < spans)) {
      add_span(span, sums);
      sums = {};
      while (span > 0 && u < t[span]) --span;
      while (span + 1 < spans && u >= t[span + 1]) ++span;
      basis = SpanBasis(t + span);
    }
    sums.add(basis(u), points[i], weights_.empty() ? 1.0 : weights_[i]);
  }
  add_span(span, sums);
}

void CubicLeastSquares::fix(std::size_t i, const Point& value) {
  const std::size_t last = rows_.size() - 1;
  for (std::size_t d = 1; d <= 3; ++d) {
    if (i >= d) {
      right_[i - d] -= rows_[i - d][d] * value;
      rows_[i - d][d] = 0;
    }
    if (i + d <= last) right_[i + d] -= rows_[i][d] * value;
  }
  rows_[i] = {1, 0, 0, 0};
  right_[i] = value;
}

// Without square roots: the factor's rows replace the matrix's, its pivots the diagonal.
bool CubicLeastSquares::factorize(std::size_t count, bool with_border) {
  double before[4] = {};  // diagonal entries ahead, before elimination
  for (std::size_t d = 0; d < std::min<std::size_t>(4, count); ++d) before[d] = rows_[d][0];
  for (std::size_t i = 0; i < count; ++i) {
    Row& row = rows_[i];
    if (!(row[0] > kSmallestPivot * before[i % 4])) return false;
    const double inverse = 1 / row[0];
    const std::size_t reach = std::min<std::size_t>(3, count - 1 - i);
    Row factors{};
    for (std::size_t a = 1; a <= reach; ++a) {
      factors[a] = row[a] * inverse;
      for (std::size_t b = a; b <= reach; ++b) rows_[i + a][b - a] -= factors[a] * row[b];
      right_[i + a] -= factors[a] * right_[i];
      if (with_border) border_[i + a] -= factors[a] * border_[i];
    }
    row = {inverse, factors[1], factors[2], factors[3]};
    if (i + 4 < count) before[i % 4] = rows_[i + 4][0];
  }
  return true;
}

void CubicLeastSquares::substitute(std::size_t count, bool with_border) {
  for (std::size_t i = count; i-- > 0;) {
    const Row& row = rows_[i];
    right_[i] *= row[0];
    if (with_border) border_[i] *= row[0];
    for (std::size_t a = 1; a <= std::min<std::size_t>(3, count - 1 - i); ++a) {
      right_[i] -= row[a] * right_[i + a];
      if (with_border) border_[i] -= row[a] * border_[i + a];
    }
  }
}

bool CubicLeastSquares::solve_open(std::span<const double> knots, std::span<const Point> points,
                                   std::span<const double> parameters, const EndTangents& tangents,
                                   std::vector<Point>& control) {
  const std::size_t count = knots.size() - 4;
  const auto solve = [&](const std::optional<Point>& second, const std::optional<Point>& before_last) {
    assemble(count, knots, points, parameters);
    fix(0, points.front());
    fix(count - 1, points.back());
    if (second) fix(1, *second);
    if (before_last) fix(count - 2, *before_last);
    if (!factorize(count, false)) return false;
    substitute(count, false);
    return true;
  };
  if (!solve({}, {})) return false;
  if (tangents.start || tangents.end) {
    // Their lengths are those of the unconstrained curve, which leaves its speed to the points.
    std::optional<Point> second, before_last;
    const auto length = [](const Vector& free, const Vector& tangent) {
      return std::max(free.dot(tangent), free.norm() / 2);
    };
    if (tangents.start) {
      second = points.front() + length(right_[1] - points.front(), *tangents.start) * *tangents.start;
    }
    if (tangents.end) {
      before_last = points.back() - length(points.back() - right_[count - 2], *tangents.end) * *tangents.end;
    }
    if (!solve(second, before_last)) return false;
  }
  control.assign(right_.begin(), right_.end());
  control.front() = points.front();
  control.back() = points.back();
  return true;
}

// Moves the last three rows and columns of the cyclic matrix to border_ and corner_.
void CubicLeastSquares::split_border(std::size_t inner) {
  const std::size_t unknowns = inner + 3;
  border_.assign(inner, Vector::Zero());
  corner_.setZero();
  const auto add = [&](std::size_t i, std::size_t j, double value) {  // i < j after sorting
    if (j < i) std::swap(i, j);
    const auto column = static_cast<Eigen::Index>(j - inner);
    if (i < inner) {
      border_[i][column] += value;
    } else {
      const auto row = static_cast<Eigen::Index>(i - inner);
      corner_(row, column) += value;
      if (row != column) corner_(column, row) += value;
    }
  };
  for (std::size_t i = inner > 3 ? inner - 3 : 0; i < unknowns; ++i) {
    for (std::size_t d = 0; d < 4; ++d) {
      const std::size_t j = (i + d) % unknowns;
      if (i < inner && j < inner) continue;
      add(i, j, rows_[i][d]);
    }
  }
}

bool CubicLeastSquares::solve_closed(std::span<const double> knots, std::span<const Point> points,
                                     std::span<const double> parameters, std::vector<Point>& control) {
  const std::size_t unknowns = knots.size() - 7, inner = unknowns - 3;
  assemble(unknowns, knots, points, parameters);
  split_border(inner);
  const std::size_t head = std::min<std::size_t>(3, inner), tail = std::max(head, inner > 3 ? inner - 3 : 0);
  const auto for_ends = [&](const auto& body) {
    std::size_t slot = 0;
    for (std::size_t i = 0; i < head; ++i) body(slot++, i);
    for (std::size_t i = tail; i < inner; ++i) body(slot++, i);
  };
  for_ends([&](std::size_t slot, std::size_t i) { border_ends_[slot] = border_[i]; });
  if (!factorize(inner, true)) return false;
  substitute(inner, true);
  Eigen::Matrix3d schur = corner_, right;
  for (std::size_t k = 0; k < 3; ++k) right.row(static_cast<Eigen::Index>(k)) = right_[inner + k].transpose();
  for_ends([&](std::size_t slot, std::size_t i) {
    schur -= border_ends_[slot] * border_[i].transpose();
    right -= border_ends_[slot] * right_[i].transpose();
  });
  const Eigen::LLT<Eigen::Matrix3d> factor(schur);
  if (factor.info() != Eigen::Success || factor.rcond() < kSmallestPivot) return false;
  const Eigen::Matrix3d last = factor.solve(right);
  control.resize(unknowns + 3);
  for (std::size_t i = 0; i < inner; ++i) control[i] = right_[i] - last.transpose() * border_[i];
  for (std::size_t k = 0; k < 3; ++k) control[inner + k] = last.row(static_cast<Eigen::Index>(k)).transpose();
  for (std::size_t k = 0; k < 3; ++k) control[unknowns + k] = control[k];
  return true;
}

}  // namespace meshcontour::detail
