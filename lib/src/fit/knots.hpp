#pragma once

// Where a spline needs its knots.

#include <cstddef>
#include <span>
#include <vector>

#include "meshcontour/types.hpp"

namespace meshcontour::detail {

/// How many spans each part of a parameter interval needs: a measure, constant on cells.
class KnotDensity {
 public:
  /// One cell over [begin, end].
  KnotDensity(double begin, double end) : at_{begin, end}, mass_{1} {}

  /// From fourth divided differences of five points at a time: a cubic spline errs by |c''''| h^4 / 720 on
  /// spans of length h [de Boor 1978, chapter XII], so that the density of spans that all err by `tolerance`
  /// follows.
  ///
  /// @param parameters  increasing, one a point, at least 2; closed: one more, the first point's again.
  KnotDensity(std::span<const Point> points, std::span<const double> parameters, bool closed,
              double tolerance);

  /// The number of spans.
  double total() const;

  /// Knots that cut the measure into equal parts, at most one in each cell if there are enough cells.
  ///
  /// @param breaks  out: spans + 1 values from the interval's begin to its end, increasing.
  void distribute(std::size_t spans, std::vector<double>& breaks) const;

  /// Makes each span of a distribution count `wanted` spans: the measure within keeps its shape.
  void rescale(std::span<const double> breaks, std::span<const double> wanted);

 private:
  double filling(double spans, double fullest) const;

  std::vector<double> at_;    // cell i lies between at_[i] and at_[i + 1]
  std::vector<double> mass_;  // of cell i
};

}  // namespace meshcontour::detail
