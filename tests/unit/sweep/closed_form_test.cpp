#include <cmath>
#include <numbers>

#include "read/swp.hpp"
#include "support/catch.hpp"
#include "survey.hpp"

using namespace sweeps;

namespace {

constexpr double kPi = std::numbers::pi;

// The samples of the first curve, as a polyline in its plane.
std::vector<Eigen::Vector2d> polyline(const std::string& text) {
  std::vector<Eigen::Vector2d> points;
  const SweepScene scene = detail::parse_swp(text, "text.swp");
  for (const CurveFrame& frame : frame_curve(scene.curves.at(0)).frames)
    points.push_back(frame.position.head<2>());
  return points;
}

Survey surveyed(const std::string& text) {
  return survey(read_text(text).shells.at(0));
}

std::string with_steps(const std::string& text, int steps) {
  std::string result = text;
  for (std::size_t at; (at = result.find('$')) != std::string::npos;) {
    const int factor = result[at + 1] - '0';
    result.replace(at, 2, std::to_string(factor * steps));
  }
  return result;
}

}  // namespace

TEST_CASE("revolutions: area and volume are those of the turned polyline", "[sweep]") {
  const std::size_t steps = GENERATE(3, 4, 7, 32, 101);
  const std::string profile = GENERATE(as<std::string>(), "bez2 p 9 4 [-1 3] [-2 1] [-0.2 0] [-1 -2]",
                                       "bez2 p 16 4 [0 1] [-1.3 1] [-1.3 -1] [0 -1]",
                                       "bsp2 p 5 7 [1 3] [2 1] [0.2 0] [1 -2] [1 3] [2 1] [0.2 0]");
  const Survey found = surveyed(profile + " srev s " + std::to_string(steps) + " p");
  const auto points = polyline(profile);
  CHECK(found.area == Approx(turned_area(points, steps)).epsilon(1e-12));
  if (found.closed()) CHECK(found.volume == Approx(turned_volume(points, steps)).epsilon(1e-12));
}

TEST_CASE("circular sweeps: area and volume are those of the turned polyline", "[sweep]") {
  const std::size_t steps = GENERATE(3, 5, 8, 60);
  const std::string profile =
      GENERATE(as<std::string>(), "circ p 7 0.5",
               "bsp2 p 6 8 [0.5 0] [0.1 0.6] [-0.4 0.2] [-0.3 -0.5] [0.2 -0.4] [0.5 0] [0.1 0.6] [-0.4 0.2]",
               "bez2 p 8 4 [0.3 -0.3] [-0.5 0] [0.1 0.4] [0.2 0.9]");
  const Survey found = surveyed(profile + " circ c " + std::to_string(steps) + " 2.5 gcyl s p c");
  auto points = polyline(profile);
  for (Eigen::Vector2d& p : points) p.x() = 2.5 - p.x();
  CHECK(found.area == Approx(turned_area(points, steps)).epsilon(1e-12));
  if (found.closed()) CHECK(found.volume == Approx(turned_volume(points, steps)).epsilon(1e-12));
}

TEST_CASE("torus: the volume of an n-gon on an m-gon", "[sweep]") {
  const double n = 24, m = 48, radius = 2, tube = 0.6;
  const Survey found = surveyed("circ t 24 0.6 circ c 48 2 gcyl s t c");
  CHECK(found.volume ==
        Approx(m * n / 2 * std::sin(2 * kPi / m) * std::sin(2 * kPi / n) * radius * tube * tube)
            .epsilon(1e-12));
}

TEST_CASE("sweeps: area and volume converge with order 2", "[sweep]") {
  // $1 and $2 stand for once and twice the number of steps.
  const auto [text, area, volume] = GENERATE(table<std::string, double, double>({
      {"circ p $1 0.5 circ c $2 2 gcyl s p c", 4 * kPi * kPi * 2 * 0.5, 2 * kPi * kPi * 2 * 0.25},
      {"bez2 p $1 4 [-1 2] [-1 1] [-1 0] [-1 -1] srev s $2 p", 2 * kPi * 3, 0},
  }));
  double last_area = 0, last_volume = 0;
  for (const int steps : {16, 32, 64, 128}) {
    const Survey found = surveyed(with_steps(text, steps));
    const double area_error = area - found.area, volume_error = volume - found.volume;
    if (last_area != 0) CHECK(std::log2(last_area / area_error) == Approx(2).margin(0.1));
    if (last_area != 0 && found.closed())
      CHECK(std::log2(last_volume / volume_error) == Approx(2).margin(0.1));
    last_area = area_error;
    last_volume = volume_error;
  }
}

TEST_CASE("knot: the volume converges to profile area times length, whatever the twist", "[sweep]") {
  // The profile is centred on the sweep, so that the curvature has no part in it.
  const SweepScene scene = detail::parse_swp(data_bytes("knot23.swp"), "knot23.swp");
  const double limit = kPi * 0.3 * 0.3 * length(to_curve(scene.curves.at(1)));
  double last = 0;
  for (const std::uint64_t steps : {2, 4, 8}) {
    SweepScene finer = scene;
    finer.curves[0].steps = 8 * steps;
    finer.curves[1].steps = steps;
    const double error = limit - survey(sweep(finer).shells.at(0)).volume;
    if (last != 0) CHECK(std::log2(last / error) == Approx(2).margin(0.1));
    last = error;
  }
}
