#pragma once

#include "meshcontour/types.hpp"

namespace meshcontour::detail {

/// A weighted sum of squared distances to planes, as a quadratic function of a point [Garland & Heckbert
/// 1997].
class Quadric {
 public:
  /// Adds factor * (normal . (p - origin))^2; the normal has length 1.
  void add_plane(const Vector& normal, const Point& origin, double factor) {
    matrix_ += factor * normal * normal.transpose();
    const double offset = normal.dot(origin);
    vector_ -= factor * offset * normal;
    constant_ += factor * offset * offset;
  }

  Quadric& operator+=(const Quadric& other) {
    matrix_ += other.matrix_;
    vector_ += other.vector_;
    constant_ += other.constant_;
    weight += other.weight;
    return *this;
  }

  double operator()(const Point& p) const {
    return std::max(0.0, p.dot(matrix_ * p) + 2 * vector_.dot(p) + constant_);
  }

  /// The minimum; where that is not clear (along a line, in a plane) what is near `guess`.
  Point minimum_near(const Point& guess) const {
    constexpr double kPull = 1e-5;
    const Eigen::Matrix3d pulled = matrix_ + kPull * matrix_.trace() * Eigen::Matrix3d::Identity();
    const Point p = guess - pulled.ldlt().solve(matrix_ * guess + vector_);
    return p.allFinite() ? p : guess;
  }

  double weight = 0;  ///< of the planes of triangles: their area

 private:
  Eigen::Matrix3d matrix_ = Eigen::Matrix3d::Zero();
  Vector vector_ = Vector::Zero();
  double constant_ = 0;
};

}  // namespace meshcontour::detail
