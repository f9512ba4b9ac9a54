#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "meshcontour/types.hpp"

namespace meshcontour::detail {

/// A symmetric positive definite system with a 3 x 3 block for each vertex of a mesh and for each side of its
/// triangles.
class BlockSystem {
 public:
  /// @param free  one a vertex: the others have no shift.
  BlockSystem(std::span<const Triangle> triangles, const std::vector<bool>& free, double diagonal);

  /// Adds |metric^(1/2) (rest - sum of weight * shift over the corners of a triangle)|^2 to what is to be
  /// least.
  void add(Index triangle, const Vector& weights, const Eigen::Matrix3d& metric, const Vector& rest);

  /// The shifts of the vertices, by conjugate gradients; near enough for a step of an iteration.
  std::vector<Vector> solve() const;

 private:
  std::vector<Vector> product(const std::vector<Vector>& x) const;

  std::span<const Triangle> triangles_;
  const std::vector<bool>& free_;
  std::vector<Eigen::Matrix3d> corners_;  // one a vertex
  std::vector<Eigen::Matrix3d> sides_;    // three a triangle
  std::vector<Vector> right_;
};

}  // namespace meshcontour::detail
