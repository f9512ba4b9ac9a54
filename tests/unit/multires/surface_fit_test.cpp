#include "multires/surface_fit.hpp"

#include <cmath>
#include <numbers>

#include "support/catch.hpp"

using namespace meshcontour;

namespace {

constexpr double kLength = 40;

// Half a pipe of radius 1 in rows of squares, its vertices off the circle by the wave.
Shell half_pipe(Index around, Index along, double wave) {
  Shell shell;
  shell.id = "pipe";
  for (Index j = 0; j <= along; ++j) {
    for (Index i = 0; i <= around; ++i) {
      const double angle = std::numbers::pi * i / around;
      const bool border = i == 0 || j == 0 || i == around || j == along;
      const double radius = 1 + (border ? 0 : wave * std::sin(7.0 * i + 3.0 * j));
      shell.points.push_back({radius * std::cos(angle), radius * std::sin(angle), kLength * j / along});
    }
  }
  for (Index j = 0; j < along; ++j) {
    for (Index i = 0; i < around; ++i) {
      const Index a = j * (around + 1) + i, b = a + 1, c = a + around + 1, d = c + 1;
      shell.triangles.push_back({a, b, d});
      shell.triangles.push_back({a, d, c});
    }
  }
  shell.patches = {{"", {}, 0, shell.triangles.size()}};
  return shell;
}

double farthest_from_pipe(const Shell& shell) {
  double largest = 0;
  for (const Point& p : shell.points) largest = std::max(largest, std::abs(std::hypot(p.x(), p.y()) - 1));
  return largest;
}

}  // namespace

TEST_CASE("surface fit: where the surface has samples the mesh comes nearer", "[multires]") {
  Shell mesh = half_pipe(48, 60, 0.01);
  detail::fit_to_surface(mesh, half_pipe(96, 480, 0), 2, 1);
  CHECK(farthest_from_pipe(mesh) < 0.004);
}

TEST_CASE("surface fit: between the far vertices of long triangles nothing is made up", "[multires]") {
  const double wave = GENERATE(1e-3, 1e-2);
  const Index rows = GENERATE(10, 25, 60);
  Shell mesh = half_pipe(30, rows, wave);
  const double before = farthest_from_pipe(mesh);
  detail::fit_to_surface(mesh, half_pipe(40, 1, 0), 2, 1);
  CHECK(farthest_from_pipe(mesh) < 1.5 * before + 1 - std::cos(std::numbers::pi / 40));
}
