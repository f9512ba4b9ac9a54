#include "multires/fitting.hpp"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <limits>

namespace meshcontour::detail {
namespace {

constexpr double kPull = 1e-6;       // beside the mean share of a point
constexpr double kTolerance = 1e-9;  // of the solution, relative
constexpr Index kNone = std::numeric_limits<Index>::max();

// Numbers the vertices that may move.
std::vector<Index> number_free(std::span<const VertexMean> means, const std::vector<bool>& fixed,
                               Index& count) {
  std::vector<Index> number(fixed.size(), kNone);
  for (const VertexMean& mean : means) {
    for (std::size_t k = 0; k < 3; ++k) {
      Index& n = number[mean.vertices[k]];
      if (mean.weights[k] > 0 && !fixed[mean.vertices[k]] && n == kNone) n = count++;
    }
  }
  return number;
}

}  // namespace

std::vector<Point> fit_vertices(std::span<const VertexMean> means, std::span<const double> shares,
                                const std::vector<bool>& fixed, std::span<const Point> points) {
  Index count = 0;
  const std::vector<Index> number = number_free(means, fixed, count);
  std::vector<Point> out(points.begin(), points.end());
  if (count == 0) return out;
  // Solved for the shifts of the vertices from where they are.
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixX3d right = Eigen::MatrixX3d::Zero(count, 3);
  double all = 0;
  for (const double share : shares) all += share;
  const double pull = kPull * all / static_cast<double>(shares.size());
  for (Index i = 0; i < count; ++i) entries.emplace_back(i, i, pull > 0 ? pull : 1);
  for (std::size_t p = 0; p < means.size(); ++p) {
    const auto& [vertices, weights] = means[p];
    Vector rest = points[p];
    for (std::size_t k = 0; k < 3; ++k) rest -= weights[k] * points[vertices[k]];
    for (std::size_t k = 0; k < 3; ++k) {
      const Index row = number[vertices[k]];
      if (row == kNone || weights[k] == 0) continue;
      right.row(row) += shares[p] * weights[k] * rest;
      for (std::size_t l = 0; l < 3; ++l) {
        const Index column = number[vertices[l]];
        if (column != kNone && weights[l] != 0) {
          entries.emplace_back(row, column, shares[p] * weights[k] * weights[l]);
        }
      }
    }
  }
  Eigen::SparseMatrix<double> matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> solver;
  solver.setTolerance(kTolerance);
  solver.setMaxIterations(500);
  solver.compute(matrix);
  const Eigen::MatrixX3d shift = solver.solve(right);
  if (!shift.allFinite()) return out;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] != kNone) out[v] += shift.row(number[v]).transpose();
  }
  return out;
}

}  // namespace meshcontour::detail
