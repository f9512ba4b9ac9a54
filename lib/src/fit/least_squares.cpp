#include "fit/least_squares.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

#include "fit/sample_pairs.hpp"

namespace meshcontour::detail {
namespace {

constexpr double kSmallestPivot = 1e-13;  // relative to the diagonal before elimination

// The four cubics that are not zero in one span, by Cox-de Boor with the divisions done once a span.
class SpanBasis {
 public:
  /// @param t  points at the knot that begins the span; t[-2] .. t[3] are used.
  explicit SpanBasis(const double* t)
      : low2_(t[-2]), low1_(t[-1]), low_(t[0]), high_(t[1]), high1_(t[2]), high2_(t[3]) {
    const Pair over2 = 1 / Pair{high_ - low1_, high1_ - low_};
    const Pair outer = 1 / Pair{high_ - low2_, high2_ - low_};
    const Pair inner = 1 / Pair{high_ - low_, high1_ - low1_};
    over2_ = {over2[0] * inner[0], over2[1] * inner[0]};
    over3_ = {outer[0], inner[1], outer[1]};
  }

  std::array<double, 4> operator()(double u) const {
    const double above = u - low_, below = high_ - u, above1 = u - low1_, below1 = high1_ - u;
    const double x = below * over2_[0], y = above * over2_[1];
    const double p = below * x * over3_[0], q = (above1 * x + below1 * y) * over3_[1];
    const double r = above * y * over3_[2];
    return {below * p, (u - low2_) * p + below1 * q, above1 * q + (high2_ - u) * r, above * r};
  }

 private:
  double low2_, low1_, low_, high_, high1_, high2_;
  std::array<double, 2> over2_;
  std::array<double, 3> over3_;
};

// The share of one span in the normal equations.
struct SpanSums {
  Pair row0[2]{}, row1[2]{}, row2{}, row3{};  // products with basis functions 0 and 1, and 2 and 3
  Pair right[3][2]{};                         // products of these with the coordinates

  void add(const std::array<double, 4>& basis, const Point& p, double weight) {
    const Pair low{basis[0], basis[1]}, high{basis[2], basis[3]};
    const Pair weighted_low = weight * low, weighted_high = weight * high;
    row0[0] += weighted_low[0] * low;
    row0[1] += weighted_low[0] * high;
    row1[0] += weighted_low[1] * low;
    row1[1] += weighted_low[1] * high;
    row2 += weighted_high[0] * high;
    row3 += weighted_high[1] * high;
    for (int c = 0; c < 3; ++c) {
      right[c][0] += p[c] * weighted_low;
      right[c][1] += p[c] * weighted_high;
    }
  }
};

}  // namespace

void CubicLeastSquares::assemble(std::size_t unknowns, std::span<const double> knots,
                                 std::span<const Point> points, std::span<const double> parameters) {
  rows_.assign(unknowns + 3, Row{});
  right_.assign(unknowns + 3, Vector::Zero());
  const double* t = knots.data() + 3;
  const auto add_span = [&](std::size_t span, std::size_t begin, std::size_t end, double shift) {
    const SpanBasis basis(t + span);
    SpanSums sums;
    for (std::size_t i = begin; i < end; ++i) {
      sums.add(basis(parameters[i] + shift), points[i], weights_.empty() ? 1.0 : weights_[i]);
    }
    const auto at = [&](std::size_t a) { return span + a < unknowns ? span + a : span + a - unknowns; };
    Row &row0 = rows_[at(0)], &row1 = rows_[at(1)], &row2 = rows_[at(2)];
    for (std::size_t d = 0; d < 2; ++d) {
      row0[d] += sums.row0[0][d];
      row0[d + 2] += sums.row0[1][d];
      row1[d + 1] += sums.row1[1][d];
      row2[d] += sums.row2[d];
    }
    row1[0] += sums.row1[0][1];
    rows_[at(3)][0] += sums.row3[1];
    for (std::size_t a = 0; a < 4; ++a) {
      const auto sum = [&](int c) { return sums.right[c][a / 2][a % 2]; };
      right_[at(a)] += Vector(sum(0), sum(1), sum(2));
    }
  };
  for_each_span(t, knots.size() - 7, parameters, add_span);
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
  for (std::size_t d = 0; d < 4; ++d) before[d] = rows_[std::min(d, count - 1)][0];
  for (std::size_t i = 0; i < count; ++i) {
    Row* row = &rows_[i];
    if (!(row[0][0] > kSmallestPivot * before[i % 4])) return false;
    before[i % 4] = rows_[std::min(i + 4, count - 1)][0];
    const double inverse = 1 / row[0][0];
    const double p = row[0][1], q = row[0][2], r = row[0][3];
    const Row factors{inverse, p * inverse, q * inverse, r * inverse};
    row[1][0] -= factors[1] * p;
    row[1][1] -= factors[1] * q;
    row[1][2] -= factors[1] * r;
    row[2][0] -= factors[2] * q;
    row[2][1] -= factors[2] * r;
    row[3][0] -= factors[3] * r;
    row[0] = factors;
    for (std::size_t a = 1; a <= 3; ++a) right_[i + a] -= factors[a] * right_[i];
    if (!with_border) continue;
    for (std::size_t a = 1; a <= 3; ++a) border_[i + a] -= factors[a] * border_[i];
  }
  return true;
}

// The three rows after the last are zero.
void CubicLeastSquares::substitute(std::vector<Vector>& column, std::size_t count) const {
  Vector next1 = Vector::Zero(), next2 = next1, next3 = next1;
  for (std::size_t i = count; i-- > 0;) {
    const Row& row = rows_[i];
    const Vector value = row[0] * column[i] - row[1] * next1 - row[2] * next2 - row[3] * next3;
    next3 = next2;
    next2 = next1;
    next1 = value;
    column[i] = value;
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
    substitute(right_, count);
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
  control.assign(right_.begin(), right_.begin() + static_cast<std::ptrdiff_t>(count));
  control.front() = points.front();
  control.back() = points.back();
  return true;
}

// Moves the last three rows and columns of the cyclic matrix to border_ and corner_, and leaves zeros.
void CubicLeastSquares::split_border(std::size_t inner) {
  const std::size_t unknowns = inner + 3;
  border_.assign(unknowns, Vector::Zero());
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
      rows_[i][d] = 0;
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
  substitute(right_, inner);
  substitute(border_, inner);
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
