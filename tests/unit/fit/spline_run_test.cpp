#include "fit/spline_run.hpp"

#include <cmath>
#include <numbers>

#include "fit/calm.hpp"
#include "support/catch.hpp"
#include "support/curves.hpp"

using namespace meshcontour;
using namespace meshcontour::test;
using detail::fit_spline_run;
using detail::SplineRunOptions;

TEST_CASE("calm_limits: on a circle 1.75 sagittas and the tolerance", "[fit]") {
  std::vector<Point> points;
  const int n = 20;
  for (int i = 0; i < n; ++i)
    points.push_back({std::cos(i * std::numbers::pi / 10), std::sin(i * std::numbers::pi / 10), 0});
  const double sagitta = 1 - std::cos(std::numbers::pi / n);
  for (const bool closed : {true, false}) {
    const auto limits = detail::calm_limits(points, closed, 1e-3);
    CHECK(limits.size() == (closed ? 20 : 19));
    for (const double limit : limits) CHECK(limit == Approx(1e-3 + 1.75 * sagitta).epsilon(1e-9));
  }
  CHECK(detail::calm_limits(std::vector<Point>{{0, 0, 0}, {1, 0, 0}}, false, 0.5) ==
        std::vector<double>{0.5});
}

TEST_CASE("fit_spline_run: two points are a line, three a parabola", "[fit]") {
  SplineRunOptions options;
  options.tolerance = 1e-4;
  const std::vector<Point> two{{1, 2, 3}, {4, 6, 3}};
  const auto line = fit_spline_run(two, options);
  CHECK(line.accepted);
  CHECK(line.curve.control_points.size() == 4);
  CHECK(line.deviation < 1e-14);
  CHECK((evaluate(line.curve, (line.parameters[0] + line.parameters[1]) / 2) - Point(2.5, 4, 3)).norm() <
        1e-14);
  const std::vector<Point> three{{0, 0, 0}, {1, 0.1, 0}, {2, 0, 0}};
  const auto parabola = fit_spline_run(three, options);
  CHECK(parabola.accepted);
  CHECK(parabola.curve.control_points.size() == 4);
  CHECK(parabola.curve.control_points.front() == three.front());
  CHECK(parabola.curve.control_points.back() == three.back());
  CHECK((evaluate(parabola.curve, parabola.parameters[1]) - three[1]).norm() < 1e-14);
}
