// Generalized cylinders: a profile carried along a curve.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "sweep/grid.hpp"
#include "sweep/polygon.hpp"
#include "sweep/rings.hpp"
#include "sweep/surface.hpp"

namespace meshcontour::detail {
namespace {

using PolygonTriangles = std::vector<std::array<std::size_t, 3>>;

double degrees(double radians) {
  return radians * 180 / std::numbers::pi;
}

// Normals of the grid before it is flipped.
class CylinderNormals {
 public:
  CylinderNormals(const Profile& profile, const Rings& rings) : profile_(profile), rings_(rings) {}

  bool smooth(std::size_t ring) const { return rings_.rings[ring].corner == 0; }
  bool smooth_column(std::size_t column) const { return !is_corner(profile_.points[column]); }

  Vector at(std::size_t ring, Side ring_side, std::size_t column, Side side) const {
    const Ring& r = rings_.rings[ring];
    const ProfilePoint& p = profile_.points[column];
    return (ring_side == Side::Before ? r.before : r.after)
        .surface_normal(p.position, side == Side::Before ? p.before : p.after);
  }

 private:
  const Profile& profile_;
  const Rings& rings_;
};

std::vector<Region> regions_of(const Profile& profile, const Rings& rings) {
  const std::vector<Range> runs = smooth_runs(rings);
  std::vector<Region> regions;
  std::size_t stretch = 0;
  for (const Range& spans : smooth_stretches(profile)) {
    ++stretch;
    for (std::size_t run = 0; run < runs.size(); ++run) {
      const std::string part = runs.size() > 1 ? fmt::format(" sweep {}", run + 1) : "";
      regions.push_back({runs[run], spans, fmt::format("profile {}{}", stretch, part)});
    }
  }
  return regions;
}

PolygonTriangles cap_triangles(const SurfaceTask& task, const Profile& profile) {
  std::vector<Eigen::Vector2d> outline;
  for (const ProfilePoint& point : profile.points) outline.push_back(point.position);
  PolygonTriangles triangles = triangulate_polygon(outline);
  if (triangles.empty()) task.warn("the profile crosses itself or has no area: the ends stay open");
  return triangles;
}

// The caps look along the sweep: the first one backwards.
void append_caps(const Grid& grid, const PolygonTriangles& triangles, Shell& shell) {
  for (const bool last : {false, true}) {
    const std::size_t ring = last ? grid.rings - 1 : 0;
    shell.patches.push_back(
        {last ? "last cap" : "first cap", shell.color, shell.triangles.size(), triangles.size()});
    for (const auto& [a, b, c] : triangles) {
      shell.triangles.push_back(
          {grid.point(ring, a), grid.point(ring, last ? b : c), grid.point(ring, last ? c : b)});
    }
  }
}

void append_cap_normals(const Rings& rings, bool flipped, std::size_t triangle, Shell& shell) {
  const std::size_t count = (shell.triangles.size() - triangle) / 2;
  const Vector first = -rings.rings.front().after.tangent, last = rings.rings.back().before.tangent;
  for (const Vector& normal : {first, last}) {
    const auto begin = shell.corner_normals.begin() + static_cast<std::ptrdiff_t>(3 * triangle);
    std::fill_n(begin, 3 * count, flipped ? Vector(-normal) : normal);
    triangle += count;
  }
}

void warn_of_corners(const SurfaceTask& task, const SampledCurve& sweep, const Rings& rings) {
  std::size_t count = 0;
  double largest = 0;
  for (const Ring& ring : rings.rings) {
    count += ring.corner > 0 ? 1 : 0;
    largest = std::max(largest, ring.corner);
  }
  if (count > 0) {
    task.warn(fmt::format("the sweep has {} corner{} of up to {:.4g} degrees", count, count > 1 ? "s" : "",
                          degrees(largest)));
  }
  if (sweep.closed && !sweep.smooth) {
    const double angle =
        angle_between(sweep.samples.back().before.tangent, sweep.samples.front().after.tangent);
    task.warn(
        fmt::format("the sweep meets itself at an angle of {:.4g} degrees: the surface stays open there",
                    degrees(angle)));
  }
}

// Where lambda = 1 - kappa . p < 0 the profile reaches past the centre of curvature of the sweep.
void warn_of_folds(const SurfaceTask& task, const Profile& profile, const Rings& rings) {
  const std::size_t count = rings.rings.size();
  std::vector<std::size_t> folded(count, 0);
  std::vector<double> least(count, std::numeric_limits<double>::infinity());
  parallel_for(count, grain_of(profile.points.size()), task.options.threads,
               [&](std::size_t begin, std::size_t end) {
                 for (std::size_t i = begin; i < end; ++i) {
                   const RingSide& side = rings.rings[i].after;
                   for (const ProfilePoint& point : profile.points) {
                     const double progress = side.progress(point.position);
                     folded[i] += progress < 0 ? 1 : 0;
                     least[i] = std::min(least[i], progress / side.speed);
                   }
                 }
               });
  std::size_t sum = 0;
  for (const std::size_t n : folded) sum += n;
  if (sum == 0) return;
  task.warn(
      fmt::format("the profile reaches past the centre of curvature of the sweep at {} of {} points "
                  "(1 - curvature * distance is {:.3g} at worst): the surface intersects itself",
                  sum, count * profile.points.size(), *std::ranges::min_element(least)));
}

// A tube with, if asked for, its caps.
void build_tube(const SurfaceTask& task, const Profile& profile, const Rings& rings, Shell& shell) {
  const unsigned threads = task.options.threads;
  Grid grid;
  grid.rings = rings.rings.size();
  grid.columns = profile.points.size();
  grid.rings_wrap = rings.wraps;
  grid.columns_wrap = profile.closed;
  grid.flip = profile.closed && profile.doubled_area() < 0;
  const auto position = [&](std::size_t ring, std::size_t column) -> Point {
    const Ring& r = rings.rings[ring];
    const Eigen::Vector2d& p = profile.points[column].position;
    return r.origin + p.x() * r.along_x + p.y() * r.along_y;
  };
  append_points(grid, position, threads, shell);
  const std::vector<Region> regions = regions_of(profile, rings);
  append_triangles(grid, regions, threads, shell);
  const std::size_t first_cap = shell.triangles.size();
  PolygonTriangles caps;
  if (task.options.caps && profile.closed && !rings.wraps) caps = cap_triangles(task, profile);
  if (!caps.empty()) append_caps(grid, caps, shell);
  const bool closed = profile.closed && (rings.wraps || !caps.empty());
  const bool inside_out = closed && signed_volume(shell, 0) < 0;
  if (inside_out) flip_triangles(shell, 0);
  if (inside_out) grid.flip = !grid.flip;
  append_normals(grid, regions, CylinderNormals(profile, rings), 0, threads, shell);
  if (!caps.empty()) append_cap_normals(rings, inside_out, first_cap, shell);
}

}  // namespace

void build_cylinder(const SurfaceTask& task, const SampledCurve& sweep, Shell& shell) {
  if (sweep.degenerate() || task.profile.degenerate()) return;
  const Profile profile = make_profile(task.profile, task.options.corner_angle);
  const Rings rings = make_rings(sweep, carry_frames(sweep, task.options.frames), task.options.corner_angle);
  const auto spans_area = [](std::size_t count, bool closed) { return count >= (closed ? 3U : 2U); };
  if (!spans_area(profile.points.size(), profile.closed) || !spans_area(rings.rings.size(), rings.wraps))
    return;
  warn_of_corners(task, sweep, rings);
  warn_of_folds(task, profile, rings);
  build_tube(task, profile, rings, shell);
}

}  // namespace meshcontour::detail
