#include "fit/least_squares.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <random>

#include "meshcontour/curve.hpp"
#include "support/catch.hpp"
#include "support/curves.hpp"

using namespace meshcontour;
using namespace meshcontour::test;
using detail::CubicLeastSquares;
using detail::EndTangents;

namespace {

std::vector<double> sorted_parameters(std::mt19937& engine, std::size_t count, double begin, double end) {
  std::vector<double> t{begin};
  while (t.size() + 1 < count) t.push_back(uniform(engine, begin, end));
  t.push_back(end);
  std::ranges::sort(t);
  return t;
}

// Every basis function at every parameter, by definition; columns i and i + unknowns are the same unknown.
Eigen::MatrixXd collocation(const BSplineCurve& curve, const std::vector<double>& t, Eigen::Index unknowns) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(t.size()), unknowns);
  for (std::size_t row = 0; row < t.size(); ++row) {
    for (std::size_t i = 0; i < curve.control_points.size(); ++i) {
      matrix(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(i) % unknowns) +=
          basis_by_definition(curve.knots, 3, i, t[row], curve.domain().second);
    }
  }
  return matrix;
}

Eigen::MatrixX3d rows(const std::vector<Point>& points) {
  Eigen::MatrixX3d matrix(points.size(), 3);
  for (std::size_t i = 0; i < points.size(); ++i)
    matrix.row(static_cast<Eigen::Index>(i)) = points[i].transpose();
  return matrix;
}

}  // namespace

TEST_CASE("least squares, closed: as a dense solution", "[fit][property]") {
  std::mt19937 engine(31);
  const std::size_t spans = GENERATE(4, 5, 6, 7, 8, 25);
  const bool weighted = GENERATE(false, true);
  BSplineCurve curve = random_periodic(engine, spans);
  const auto [begin, end] = curve.domain();
  std::vector<double> t = sorted_parameters(engine, 5 * spans, begin, end - 0.01);
  std::vector<Point> points;
  for (std::size_t i = 0; i < t.size(); ++i) points.push_back(random_point(engine));
  CubicLeastSquares solver;
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(t.size()));
  if (weighted) {
    for (Eigen::Index i = 0; i < weights.size(); ++i) weights[i] = uniform(engine, 0.2, 2);
    solver.set_weights({weights.begin(), weights.end()});
  }
  const Eigen::VectorXd root = weights.cwiseSqrt();
  const Eigen::MatrixXd matrix = root.asDiagonal() * collocation(curve, t, static_cast<Eigen::Index>(spans));
  const Eigen::MatrixX3d expected = matrix.colPivHouseholderQr().solve(root.asDiagonal() * rows(points));
  std::vector<Point> control;
  REQUIRE(solver.solve_closed(curve.knots, points, t, control));
  REQUIRE(control.size() == spans + 3);
  for (std::size_t i = 0; i < control.size(); ++i) {
    CHECK((control[i].transpose() - expected.row(static_cast<Eigen::Index>(i % spans))).norm() < 1e-10);
  }
  // A period away is the same place.
  t[3] += end - begin;
  std::vector<Point> again;
  REQUIRE(solver.solve_closed(curve.knots, points, t, again));
  for (std::size_t i = 0; i < control.size(); ++i) CHECK((control[i] - again[i]).norm() < 1e-10);
}

TEST_CASE("least squares, open: as a dense solution with the ends fixed", "[fit][property]") {
  std::mt19937 engine(32);
  const std::size_t count = GENERATE(4, 5, 6, 12, 40);
  BSplineCurve curve = random_curve(engine, 3, count, true, false);
  const auto [begin, end] = curve.domain();
  const std::vector<double> t = sorted_parameters(engine, 6 * count, begin, end);
  std::vector<Point> points;
  for (std::size_t i = 0; i < t.size(); ++i) points.push_back(random_point(engine));
  CubicLeastSquares solver;
  std::vector<Point> control;
  REQUIRE(solver.solve_open(curve.knots, points, t, {}, control));
  REQUIRE(control.size() == count);
  CHECK(control.front() == points.front());
  CHECK(control.back() == points.back());
  const auto unknowns = static_cast<Eigen::Index>(count);
  const Eigen::MatrixXd matrix = collocation(curve, t, unknowns);
  const Eigen::MatrixX3d rest = rows(points) - matrix.col(0) * points.front().transpose() -
                                matrix.col(unknowns - 1) * points.back().transpose();
  const Eigen::MatrixX3d expected = matrix.middleCols(1, unknowns - 2).colPivHouseholderQr().solve(rest);
  for (std::size_t i = 1; i + 1 < count; ++i) {
    CHECK((control[i].transpose() - expected.row(static_cast<Eigen::Index>(i) - 1)).norm() < 1e-9);
  }
}

TEST_CASE("least squares: a spline's own points give it back", "[fit]") {
  std::mt19937 engine(33);
  const BSplineCurve open = random_curve(engine, 3, 20, true, false), closed = random_periodic(engine, 20);
  CubicLeastSquares solver;
  std::vector<Point> control;
  for (const BSplineCurve& curve : {open, closed}) {
    const auto [begin, end] = curve.domain();
    std::vector<double> t;
    std::vector<Point> points;
    for (int k = 0; k < 200; ++k) {
      t.push_back(begin + (end - begin) * k / (curve.periodic ? 200 : 199));
      points.push_back(evaluate(curve, t.back()));
    }
    REQUIRE((curve.periodic ? solver.solve_closed(curve.knots, points, t, control)
                            : solver.solve_open(curve.knots, points, t, {}, control)));
    for (std::size_t i = 0; i < control.size(); ++i)
      CHECK((control[i] - curve.control_points[i]).norm() < 1e-9);
  }
}

TEST_CASE("least squares: tangents at the ends are kept", "[fit]") {
  std::mt19937 engine(34);
  const BSplineCurve curve = random_curve(engine, 3, 10, true, false);
  const auto [begin, end] = curve.domain();
  std::vector<double> t = sorted_parameters(engine, 60, begin, end);
  std::vector<Point> points;
  for (const double u : t) points.push_back(evaluate(curve, u));
  const Vector start =
      (curve.control_points[1] - curve.control_points[0] + 0.1 * random_point(engine)).normalized();
  const Vector stop =
      (curve.control_points[9] - curve.control_points[8] + 0.1 * random_point(engine)).normalized();
  CubicLeastSquares solver;
  std::vector<Point> control;
  REQUIRE(solver.solve_open(curve.knots, points, t, EndTangents{start, stop}, control));
  CHECK((control[1] - control[0]).normalized().dot(start) == Approx(1).epsilon(1e-14));
  CHECK((control[9] - control[8]).normalized().dot(stop) == Approx(1).epsilon(1e-14));
}

TEST_CASE("least squares: spans without points are refused", "[fit]") {
  const std::vector<double> knots{0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 8, 8, 8};
  std::vector<double> t{0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 7.9, 8};
  std::vector<Point> points(t.size(), Point(1, 2, 3)), control;
  CubicLeastSquares solver;
  CHECK_FALSE(solver.solve_open(knots, points, t, {}, control));
}
