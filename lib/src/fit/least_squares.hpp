#pragma once

// Linear least squares for cubic B-splines with given knots and parameters.

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "meshcontour/types.hpp"

namespace meshcontour::detail {

/// Directions that an open curve keeps at its ends.
struct EndTangents {
  std::optional<Vector> start, end;  ///< of length 1, in the direction of travel
};

/// The control points that minimise the sum of squared distances at the parameters.
///
/// Normal equations of half-bandwidth 3, by Cholesky without pivoting. A closed curve adds three border
/// columns, which a 3 x 3 Schur complement eliminates. O(points + spans); the memory is kept between calls.
class CubicLeastSquares {
 public:
  /// Weights of the points, squared distances times these; empty: all 1. Kept until set again.
  void set_weights(std::vector<double> weights) { weights_ = std::move(weights); }

  /// An open curve: it starts and ends at the first and the last point to the last bit.
  ///
  /// @param knots       clamped: the first four equal, and the last four; one span at least.
  /// @param parameters  one a point, increasing, from the first knot to the last.
  /// @param control     knots.size() - 4 control points, out.
  /// @return            false if the points do not determine the curve: too few of them in a row of spans.
  bool solve_open(std::span<const double> knots, std::span<const Point> points,
                  std::span<const double> parameters, const EndTangents& tangents,
                  std::vector<Point>& control);

  /// A periodic curve of m >= 4 spans.
  ///
  /// @param knots       t[-3] .. t[m + 3], the outer ones repeating the inner ones a period away.
  /// @param parameters  increasing; each in [t[0], t[m]] or less than a period outside.
  /// @param control     m + 3 control points, out, the first three repeated at the end.
  bool solve_closed(std::span<const double> knots, std::span<const Point> points,
                    std::span<const double> parameters, std::vector<Point>& control);

 private:
  using Row = std::array<double, 4>;  // entries (i, i) .. (i, i + 3) of the symmetric matrix, i + 3 counted
                                      // cyclically

  void assemble(std::size_t unknowns, std::span<const double> knots, std::span<const Point> points,
                std::span<const double> parameters);
  void fix(std::size_t i, const Point& value);
  void split_border(std::size_t inner);
  bool factorize(std::size_t count, bool with_border);
  void substitute(std::vector<Vector>& column, std::size_t count) const;

  std::vector<double> weights_;
  std::vector<Row> rows_;  // and three of zeros, as right_ and border_
  std::vector<Vector> right_;
  std::vector<Vector> border_;         // row i: the entries (i, inner) .. (i, inner + 2)
  Eigen::Matrix3d corner_;             // the border's own square
  std::array<Vector, 6> border_ends_;  // the only rows of border_ that are not zero before elimination
};

}  // namespace meshcontour::detail
