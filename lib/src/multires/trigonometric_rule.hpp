#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>

namespace meshcontour::detail {

/// The weights of a vertex with k triangles between two sharp edges, for the odd vertex of one of the edges
/// between these: edges and their other ends are numbered from 0 to k [Zorin & Schroeder 2000].
class TrigonometricRule {
 public:
  /// @param triangles  k, 2 or more.
  explicit TrigonometricRule(std::size_t triangles)
      : count_(static_cast<double>(triangles)), angle_(std::numbers::pi / count_) {}

  /// Of the vertex itself, for edge i, 1 to k - 1.
  double centre(std::size_t i) const {
    return 1 - std::sin(angle_) * sine(i) / (count_ * (1 - std::cos(angle_)));
  }

  /// Of neighbour 0; neighbour k has its opposite.
  double end(std::size_t i) const {
    return std::cos(static_cast<double>(i) * angle_) / 4 -
           std::sin(2 * angle_) * double_sine(i) / (4 * count_ * (std::cos(angle_) - std::cos(2 * angle_)));
  }

  /// Of neighbour j, 1 to k - 1: two products, so that two sums over the neighbours serve all edges.
  double inner(std::size_t i, std::size_t j) const { return inner(i, sine(j), double_sine(j)); }

  /// The same for weighted sums of sine(j) and double_sine(j).
  template <class Value>
  Value inner(std::size_t i, const Value& sines, const Value& double_sines) const {
    return (sine(i) * sines + double_sine(i) * double_sines / 2) / count_;
  }

  double sine(std::size_t i) const { return std::sin(static_cast<double>(i) * angle_); }
  double double_sine(std::size_t i) const { return std::sin(2 * (static_cast<double>(i) * angle_)); }

 private:
  double count_, angle_;
};

}  // namespace meshcontour::detail
