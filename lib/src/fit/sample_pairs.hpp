#pragma once

// Samples of a run two at a time, the two side by side in one register.

#include <cstddef>
#include <span>

#include "meshcontour/types.hpp"

namespace meshcontour::detail {

/// Two numbers, in one register where the machine has such.
using Pair [[gnu::vector_size(16)]] = double;

inline Pair pair_of(double both) {
  return Pair{both, both};
}

inline Pair largest(Pair a, Pair b) {
  return a > b ? a : b;
}

inline Pair smallest(Pair a, Pair b) {
  return a < b ? a : b;
}

/// Two points, or two vectors, by coordinates.
struct PointPair {
  Pair x, y, z;

  PointPair(Pair all_x, Pair all_y, Pair all_z) : x(all_x), y(all_y), z(all_z) {}
  PointPair(const Point& a, const Point& b) : x{a.x(), b.x()}, y{a.y(), b.y()}, z{a.z(), b.z()} {}

  Pair dot(const PointPair& other) const { return x * other.x + y * other.y + z * other.z; }
};

/// Calls use(span, begin, end, shift) for runs of samples begin .. end - 1 that lie in one span once `shift`
/// is added to their parameters: a period, or 0.
///
/// @param breaks      spans + 1, increasing.
/// @param parameters  increasing; below or above the breaks by less than a period.
template <typename Use>
void for_each_span(const double* breaks, std::size_t spans, std::span<const double> parameters,
                   const Use& use) {
  const double low = breaks[0], high = breaks[spans], period = high - low;
  const auto shift_of = [&](double t) { return t < low ? period : t > high ? -period : 0; };
  std::size_t span = 0;
  for (std::size_t begin = 0; begin < parameters.size();) {
    const double shift = shift_of(parameters[begin]), u = parameters[begin] + shift;
    while (span > 0 && u < breaks[span]) --span;
    while (span + 1 < spans && u >= breaks[span + 1]) ++span;
    std::size_t end = begin + 1;
    for (; end < parameters.size() && shift_of(parameters[end]) == shift; ++end) {
      if (span + 1 < spans && parameters[end] + shift >= breaks[span + 1]) break;
    }
    use(span, begin, end, shift);
    begin = end;
  }
}

}  // namespace meshcontour::detail
