// Time of swept surfaces, a vertex, beside a loop that only evaluates V + x N + y B. Processor time, best of
// three.

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <numbers>

#include "bench/bench.hpp"
#include "meshcontour/sweep.hpp"

using namespace meshcontour;

namespace {

SweepScene tube_scene(std::uint64_t around, std::uint64_t along) {
  SweepCurve circle, path;
  circle.kind = SweepCurve::Kind::Circle;
  circle.steps = around;
  circle.radius = 0.3;
  path.kind = SweepCurve::Kind::BSpline;
  path.planar = false;
  path.steps = along / 5;
  path.control_points = {{2, 0, 0},  {0, 2, 1}, {-2, 0, 0}, {0, -2, -1},
                         {1, -1, 0}, {2, 0, 0}, {0, 2, 1},  {-2, 0, 0}};
  SweepSurface tube;
  tube.kind = SweepSurface::Kind::Cylinder;
  tube.sweep = 1;
  return {{circle, path}, {tube}};
}

SweepScene revolution_scene(std::uint64_t around, std::uint64_t along) {
  SweepCurve profile;
  profile.steps = along;
  profile.control_points = {{1, 0, 0}, {2, 1, 0}, {3, 2, 0}, {2, 4, 0}};
  SweepSurface surface;
  surface.steps = around;
  return {{profile}, {surface}};
}

// A loop that evaluates the points of a tube and does nothing else.
void plain_loop(std::size_t around, std::size_t along) {
  std::vector<Eigen::Vector2d> profile(around);
  for (std::size_t j = 0; j < around; ++j) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(j) / static_cast<double>(around);
    profile[j] = {std::cos(angle), std::sin(angle)};
  }
  std::vector<Point> points;
  points.reserve(around * along);
  for (std::size_t i = 0; i < along; ++i) {
    const Vector normal = Vector(1, static_cast<double>(i), 0).normalized();
    for (const Eigen::Vector2d& p : profile) {
      points.push_back(Vector::UnitX() + p.x() * normal + p.y() * Vector::UnitZ());
    }
  }
  if (points.back().hasNaN()) std::abort();
}

bool has_triangles(const SweepScene& scene, const SweepOptions& options, std::size_t triangles) {
  return sweep(scene, options).shells.at(0).triangles.size() == triangles;
}

// False if a mesh is not as large as it should be.
bool run(std::size_t around, std::size_t along) {
  SweepOptions options;
  options.max_frames = 0;
  options.threads = 1;
  const SweepScene tube = tube_scene(around, along), revolution = revolution_scene(around, along);
  const std::size_t triangles = 2 * around * along;
  if (!has_triangles(tube, options, triangles) || !has_triangles(revolution, options, triangles))
    return false;
  std::vector<bench::Contender> contenders = {{"tube", [&] { sweep(tube, options); }},
                                              {"revolution", [&] { sweep(revolution, options); }},
                                              {"plain loop", [&] { plain_loop(around, along); }}};
  bench::alternate(contenders, 3);
  for (const bench::Contender& contender : contenders) {
    fmt::print("| {} x {} | {} | {} | {:.3f} | {:.1f} |\n", around, along, triangles, contender.name,
               contender.median(), contender.median() * 1e9 / static_cast<double>(around * along));
  }
  return true;
}

}  // namespace

int main() {
  bool right = true;
  fmt::print("| around x along | triangles | what | CPU seconds | ns / vertex |\n|---|---|---|---|---|\n");
  right = run(100, 500) && right;
  right = run(100, 5000) && right;
  right = run(1000, 5000) && right;
  right = run(50, 100'000) && right;
  return right ? EXIT_SUCCESS : EXIT_FAILURE;
}
