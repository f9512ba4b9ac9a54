#pragma once

// The smallest number of spans with which a curve is accepted.

#include <vector>

#include "fit/knots.hpp"
#include "fit/spline_fit.hpp"

namespace meshcontour::detail {

/// Tries numbers of spans, starting with what the density says, and moves the knots to where the errors are.
class SpanSearch {
 public:
  SpanSearch(SplineFit& fit, const RunSamples& samples, KnotDensity density);

  /// False if no number of spans is accepted, which happens where a curve through all the points swings out.
  bool search();

  /// Whether these knots are accepted as they are.
  bool accept(std::span<const double> breaks);

  /// Of the accepted curve.
  const BSplineCurve& curve() const { return best_.curve; }
  const std::vector<double>& parameters() const { return best_.parameters; }
  const std::vector<double>& breaks() const { return best_.breaks; }
  double vertex_error() const { return best_.vertex_error; }
  /// Where the accepted curve and those near it wanted their knots.
  const KnotDensity& density() const { return start_; }

 private:
  struct Best {
    BSplineCurve curve;
    std::vector<double> parameters, breaks;
    double vertex_error = 0;
  };

  std::size_t search_below(std::size_t accepted);
  std::size_t reduced(std::size_t accepted);
  bool attempt(std::size_t spans);
  bool no_fewer(std::size_t accepted, std::size_t rejected) const;
  bool try_density(KnotDensity density, std::size_t spans);
  void balance(KnotDensity& density, double power);
  void keep();

  SplineFit& fit_;
  const RunSamples& samples_;
  std::size_t lowest_, highest_;
  KnotDensity first_, start_;             // from the points alone; that of the best fit
  std::vector<double> start_parameters_;  // of the best fit
  double start_error_;
  std::vector<double> breaks_, wanted_;
  double needed_ = 0;   // spans, by the last fit
  int balancings_ = 0;  // of the knots before the last fit
  int rounds_ = 1;
  bool thorough_ = false, quick_ = false;
  Best best_;
};

}  // namespace meshcontour::detail
