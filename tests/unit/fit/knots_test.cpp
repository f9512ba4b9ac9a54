#include "fit/knots.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fit/parametrize.hpp"
#include "support/catch.hpp"

using namespace meshcontour;
using detail::KnotDensity;

namespace {

std::vector<Point> sine(int n) {
  std::vector<Point> points;
  for (int i = 0; i < n; ++i) points.push_back({i * 0.1, std::sin(i * 0.1), 0});
  return points;
}

std::vector<double> even(std::size_t n) {
  std::vector<double> t;
  for (std::size_t i = 0; i < n; ++i) t.push_back(0.1 * static_cast<double>(i));
  return t;
}

}  // namespace

TEST_CASE("KnotDensity: ten thousand times the tolerance, a tenth of the spans", "[fit]") {
  const auto points = sine(400);
  const double fine = KnotDensity(points, even(400), false, 1e-8).total();
  const double coarse = KnotDensity(points, even(400), false, 1e-4).total();
  CHECK(fine == Approx(10 * coarse).epsilon(1e-9));
  // |c''''| = |sin|: its fourth root has the mean 0.8595; 39.9 long, over (720e-8)^(1/4).
  CHECK(fine == Approx(39.7 * 0.8595 / std::pow(720e-8, 0.25)).epsilon(0.03));
}

TEST_CASE("KnotDensity: knots come in order, as many as asked for, one a chord at most", "[fit]") {
  const auto points = sine(60);
  const KnotDensity density(points, even(60), false, 1e-6);
  std::vector<double> breaks;
  const std::size_t spans = GENERATE(1, 2, 7, 30, 57);
  density.distribute(spans, breaks);
  REQUIRE(breaks.size() == spans + 1);
  CHECK(breaks.front() == 0);
  CHECK(breaks.back() == Approx(5.9).epsilon(1e-15));
  for (std::size_t k = 0; k < spans; ++k) CHECK(breaks[k] < breaks[k + 1]);
  for (std::size_t i = 0; i + 1 < 60; ++i) {
    const auto inside = [&](double b) {
      return b > 0.1 * static_cast<double>(i) && b <= 0.1 * static_cast<double>(i + 1);
    };
    CHECK(std::count_if(breaks.begin() + 1, breaks.end() - 1, inside) <= 1);
  }
}

TEST_CASE("KnotDensity: rescaled spans take as many knots as they want", "[fit]") {
  KnotDensity density(0, 8);
  std::vector<double> breaks;
  density.distribute(4, breaks);
  CHECK(breaks == std::vector<double>{0, 2, 4, 6, 8});
  KnotDensity cells(sine(81), even(81), false, 1e-6);
  cells.distribute(8, breaks);
  std::vector<double> wanted(8, 1.0);
  wanted[3] = 3;
  cells.rescale(breaks, wanted);
  CHECK(cells.total() == Approx(10).epsilon(1e-9));
  std::vector<double> again;
  cells.distribute(10, again);
  const auto inside = [&](double b) { return b > breaks[3] + 1e-9 && b < breaks[4] - 1e-9; };
  CHECK(std::ranges::count_if(again, inside) == 2);
}

TEST_CASE("chord_geometry: on a circle the arc's own length and sagitta", "[fit]") {
  std::vector<Point> points;
  const int n = GENERATE(12, 20, 1000);
  const double step = 2 * std::numbers::pi / n;
  for (int i = 0; i < n; ++i) points.push_back({std::cos(i * step), std::sin(i * step), 0});
  for (const bool closed : {true, false}) {
    const auto geometry = detail::chord_geometry(points, closed);
    REQUIRE(geometry.parameters.size() == points.size() + (closed ? 1 : 0));
    for (std::size_t i = 0; i < geometry.parameters.size(); ++i) {
      CHECK(geometry.parameters[i] == Approx(step * static_cast<double>(i)).epsilon(1e-10));
    }
    for (const double s : geometry.sagittas) CHECK(s == Approx(1 - std::cos(step / 2)).epsilon(1e-9));
    CHECK(detail::calm_limits(geometry.sagittas, 0.5)[1] ==
          Approx(0.5 + 1.75 * (1 - std::cos(step / 2))).epsilon(1e-9));
  }
}
