// Time of swept surfaces, a vertex, beside a loop that only evaluates V + x N + y B. Processor time, best of
// three.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <numbers>

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

// Seconds of the fastest of three runs.
template <class Run>
double best_time(const Run& run) {
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const std::clock_t start = std::clock();
    run();
    best = std::min(best, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return best;
}

double plain_loop_time(std::size_t around, std::size_t along) {
  std::vector<Eigen::Vector2d> profile(around);
  for (std::size_t j = 0; j < around; ++j) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(j) / static_cast<double>(around);
    profile[j] = {std::cos(angle), std::sin(angle)};
  }
  return best_time([&] {
    std::vector<Point> points;
    points.reserve(around * along);
    for (std::size_t i = 0; i < along; ++i) {
      const Vector normal = Vector(1, static_cast<double>(i), 0).normalized();
      for (const Eigen::Vector2d& p : profile) {
        points.push_back(Vector::UnitX() + p.x() * normal + p.y() * Vector::UnitZ());
      }
    }
    if (points.back().hasNaN()) std::abort();
  });
}

bool measure(const char* name, const SweepScene& scene, std::size_t around, std::size_t along) {
  SweepOptions options;
  options.max_frames = 0;
  options.threads = 1;
  const Model model = sweep(scene, options);
  const std::size_t points = model.shells.at(0).points.size(), triangles = model.shells[0].triangles.size();
  if (triangles != 2 * around * along) return false;
  const double time = best_time([&] { sweep(scene, options); });
  const double per_point = 1e9 / static_cast<double>(points);
  const double plain = plain_loop_time(around, along) * 1e9 / static_cast<double>(around * along);
  fmt::print(
      "{{\"case\":\"{}\",\"around\":{},\"along\":{},\"triangles\":{},\"seconds\":{:.3f},\"ns_per_vertex\":{:."
      "1f},"
      "\"plain_loop_ns_per_vertex\":{:.1f}}}\n",
      name, around, along, triangles, time, time * per_point, plain);
  return true;
}

}  // namespace

int main() {
  bool right = true;
  for (const auto& [around, along] : {std::pair{100, 500}, {100, 5000}, {1000, 5000}, {50, 100'000}}) {
    const auto a = static_cast<std::size_t>(around), b = static_cast<std::size_t>(along);
    right = measure("tube", tube_scene(a, b), a, b) && right;
    right = measure("revolution", revolution_scene(a, b), a, b) && right;
  }
  return right ? EXIT_SUCCESS : EXIT_FAILURE;
}
