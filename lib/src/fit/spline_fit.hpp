#pragma once

// One least-squares spline of a run: knots in, curve, footpoints and errors out.

#include <cstdint>
#include <span>
#include <vector>

#include "fit/least_squares.hpp"
#include "fit/run_samples.hpp"
#include "fit/taylor_piece.hpp"
#include "meshcontour/curve.hpp"

namespace meshcontour::detail {

/// A cubic with given knots that is moved to the points by turns: control points by least squares, parameters
/// to the nearest points of the curve by Newton's method [Hoschek 1988]. Memory is kept from fit to fit.
class SplineFit {
 public:
  explicit SplineFit(const RunSamples& samples);

  /// Fits with these knots, from the parameters of the fit before.
  ///
  /// @param breaks  from 0 to the end.
  /// @return        false if the points do not determine the curve.
  bool fit(std::span<const double> breaks, int rounds);

  const BSplineCurve& curve() const { return curve_; }
  const std::vector<double>& parameters() const { return parameters_; }
  void set_parameters(std::span<const double> parameters) {
    parameters_.assign(parameters.begin(), parameters.end());
  }

  /// Largest distance of a point to the curve.
  double vertex_error() const { return vertex_error_; }

  /// Whether all points lie within the tolerance and the curve within the limits of all chords.
  bool accepted();

  /// For each span, the largest error of its points as a multiple of the tolerance, and, if all points are
  /// within that, of its chords as a multiple of their limits where beyond; after accepted().
  const std::vector<double>& span_errors() const { return span_errors_; }
  double worst_error() const { return worst_error_; }

 private:
  // The curve at a point's parameter.
  struct AtPoint {
    double error, acceleration;  // squares of its distance to the point and of |C''|
    std::size_t span;
  };

  void set_knots(std::span<const double> breaks);
  void update_pieces();
  void limit_moves();
  void move_footpoints();
  void measure();
  double chord_bound(std::size_t i) const;

  const RunSamples& run_;
  std::vector<double> parameters_, earliest_, latest_;
  CubicLeastSquares solver_;
  BSplineCurve curve_;
  std::vector<TaylorPiece> pieces_;
  std::vector<AtPoint> at_points_;
  std::vector<double> span_errors_;
  double vertex_error_ = 0, worst_error_ = 0;
};

}  // namespace meshcontour::detail
