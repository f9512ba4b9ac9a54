#include <random>

#include "meshcontour/curve.hpp"
#include "support/catch.hpp"
#include "support/curves.hpp"

using namespace meshcontour;
using namespace meshcontour::test;

TEST_CASE("basis_functions: they are the recursive definition, and sum to one", "[curve][property]") {
  std::mt19937 engine(1);
  const int degree = GENERATE(1, 2, 3, 5, 9);
  const BSplineCurve curve = random_curve(engine, degree, static_cast<std::size_t>(degree) + 6, true, false);
  const auto [begin, end] = curve.domain();
  for (int k = 0; k <= 50; ++k) {
    const double u = begin + (end - begin) * k / 50;
    const std::size_t span = find_span(curve, u);
    const Eigen::MatrixXd basis = basis_functions(curve.knots, degree, span, u, 2);
    CHECK(basis.rows() == 3);
    CHECK(basis.row(0).sum() == Approx(1).epsilon(1e-13));
    CHECK(std::abs(basis.row(1).sum()) < 1e-10);
    for (int r = 0; r <= degree; ++r) {
      const std::size_t i = span - static_cast<std::size_t>(degree - r);
      CHECK(std::abs(basis(0, r) - basis_by_definition(curve.knots, degree, i, u, end)) < 1e-13);
    }
  }
}

TEST_CASE("find_span: the span that is not empty, also at the end and outside", "[curve]") {
  BSplineCurve curve{2, {0, 0, 0, 1, 1, 3, 3, 3}, std::vector<Point>(5, Point::Zero()), {}, false};
  CHECK(find_span(curve, -5) == 2);
  CHECK(find_span(curve, 0) == 2);
  CHECK(find_span(curve, 0.5) == 2);
  CHECK(find_span(curve, 1) == 4);
  CHECK(find_span(curve, 3) == 4);
  CHECK(find_span(curve, 99) == 4);
  curve.knots = {0, 0, 0, 1, 3, 3, 3, 3};  // the last span is empty
  CHECK(find_span(curve, 3) == 3);
}

TEST_CASE("evaluate: positions are the sum of the definition", "[curve][property]") {
  std::mt19937 engine(2);
  const int degree = GENERATE(1, 2, 3, 4, 9);
  const bool clamped = GENERATE(true, false), rational = GENERATE(true, false);
  const BSplineCurve curve =
      random_curve(engine, degree, static_cast<std::size_t>(degree) + 5, clamped, rational);
  const auto [begin, end] = curve.domain();
  for (int k = 0; k <= 40; ++k) {
    const double u = begin + (end - begin) * k / 40;
    CHECK((evaluate(curve, u) - position_by_definition(curve, u)).norm() < 1e-12);
  }
  if (clamped && !rational) {  // to the last bit
    CHECK(evaluate(curve, begin) == curve.control_points.front());
    CHECK(evaluate(curve, end) == curve.control_points.back());
  }
}

TEST_CASE("derivatives: they are the limits of difference quotients", "[curve][property]") {
  std::mt19937 engine(3);
  const bool rational = GENERATE(true, false);
  const int degree = GENERATE(2, 3, 5);
  const BSplineCurve curve = random_curve(engine, degree, 9, true, rational);
  const double u = (curve.knots[6] + curve.knots[7]) / 2, h = 1e-4;
  const Eigen::MatrixX3d at = derivatives(curve, u, 3);
  const Eigen::MatrixX3d before = derivatives(curve, u - h, 2), after = derivatives(curve, u + h, 2);
  for (int k = 0; k < 3; ++k) {
    const Eigen::RowVector3d quotient = (after.row(k) - before.row(k)) / (2 * h);
    CHECK((quotient - at.row(k + 1)).norm() < 1e-5 * (1 + at.row(k + 1).norm()));
  }
}

TEST_CASE("derivatives: beyond the degree a polynomial has none, a circle does", "[curve]") {
  std::mt19937 engine(4);
  const BSplineCurve cubic = random_curve(engine, 3, 8, true, false);
  CHECK(derivatives(cubic, cubic.knots[4] + 0.01, 5).bottomRows(2).isZero());
  const BSplineCurve quarter{
      2, {0, 0, 0, 1, 1, 1}, {{1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {1, std::sqrt(0.5), 1}, false};
  const Eigen::MatrixX3d d = derivatives(quarter, 0.3, 3);
  // |C|^2 = 1, differentiated three times.
  CHECK(std::abs(d.row(0).dot(d.row(1))) < 1e-14);
  CHECK(std::abs(d.row(1).squaredNorm() + d.row(0).dot(d.row(2))) < 1e-13);
  CHECK(std::abs(3 * d.row(1).dot(d.row(2)) + d.row(0).dot(d.row(3))) < 1e-12);
}
