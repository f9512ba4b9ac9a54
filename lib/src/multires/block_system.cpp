#include "multires/block_system.hpp"

#include <Eigen/LU>
#include <cmath>

namespace meshcontour::detail {
namespace {

constexpr double kTolerance = 1e-4;  // of the residual, relative
constexpr int kMostSteps = 100;

double dot(const std::vector<Vector>& a, const std::vector<Vector>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
  return sum;
}

}  // namespace

BlockSystem::BlockSystem(std::span<const Triangle> triangles, const std::vector<bool>& free, double diagonal)
    : triangles_(triangles),
      free_(free),
      corners_(free.size(), diagonal * Eigen::Matrix3d::Identity()),
      sides_(3 * triangles.size(), Eigen::Matrix3d::Zero()),
      right_(free.size(), Vector::Zero()) {}

void BlockSystem::add(Index triangle, const Vector& weights, const Eigen::Matrix3d& metric,
                      const Vector& rest) {
  const Triangle& t = triangles_[triangle];
  const Vector pulled = metric * rest;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const Index v = t[static_cast<std::size_t>(k)];
    corners_[v] += weights[k] * weights[k] * metric;
    sides_[3 * triangle + static_cast<std::size_t>(k)] += weights[k] * weights[(k + 1) % 3] * metric;
    if (free_[v]) right_[v] += weights[k] * pulled;
  }
}

std::vector<Vector> BlockSystem::product(const std::vector<Vector>& x) const {
  std::vector<Vector> y(x.size());
  for (std::size_t v = 0; v < x.size(); ++v) y[v].noalias() = corners_[v] * x[v];
  for (std::size_t h = 0; h < sides_.size(); ++h) {
    const Index u = triangles_[h / 3][h % 3], v = triangles_[h / 3][(h + 1) % 3];
    y[u].noalias() += sides_[h] * x[v];
    y[v].noalias() += sides_[h] * x[u];
  }
  for (std::size_t v = 0; v < y.size(); ++v) {
    if (!free_[v]) y[v].setZero();
  }
  return y;
}

std::vector<Vector> BlockSystem::solve() const {
  std::vector<Eigen::Matrix3d> inverses(corners_.size());
  for (std::size_t v = 0; v < corners_.size(); ++v) inverses[v] = corners_[v].inverse();
  const auto conditioned = [&](const std::vector<Vector>& r) {
    std::vector<Vector> z(r.size());
    for (std::size_t v = 0; v < r.size(); ++v) z[v].noalias() = inverses[v] * r[v];
    return z;
  };
  std::vector<Vector> x(right_.size(), Vector::Zero()), r = right_, z = conditioned(r), p = z;
  double size = dot(r, z);
  const double enough = kTolerance * kTolerance * size;
  for (int step = 0; step < kMostSteps && size > enough; ++step) {
    const std::vector<Vector> q = product(p);
    const double curvature = dot(p, q);
    if (!(curvature > 0)) break;
    const double along = size / curvature;
    for (std::size_t v = 0; v < x.size(); ++v) {
      x[v] += along * p[v];
      r[v] -= along * q[v];
    }
    z = conditioned(r);
    const double next = dot(r, z);
    for (std::size_t v = 0; v < x.size(); ++v) p[v] = z[v] + next / size * p[v];
    size = next;
  }
  return x;
}

}  // namespace meshcontour::detail
