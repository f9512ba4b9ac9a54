// Surfaces of revolution.

#include <fmt/format.h>

#include <cmath>

#include "sweep/beads.hpp"
#include "sweep/grid.hpp"
#include "sweep/surface.hpp"

namespace meshcontour::detail {
namespace {

constexpr double kSameFraction = 1e-9;  // of the size of the profile

// The axis, and the directions in which the profile's x axis points at each ring; neighbours turn
// counter-clockwise.
struct Axis {
  Vector direction;
  std::vector<Vector> radial;
};

Axis make_axis(SweepSurface::Kind kind, std::size_t rings) {
  const bool about_y = kind == SweepSurface::Kind::Revolution;
  Axis axis{about_y ? Vector::UnitY() : Vector::UnitZ(), {}};
  axis.radial.reserve(rings);
  for (std::size_t i = 0; i < rings; ++i) {
    const Eigen::Vector2d p = unit_circle_point(i, rings);
    // A circle's normal points to its centre.
    axis.radial.push_back(about_y ? Vector(p.x(), 0, -p.y()) : Vector(-p.x(), -p.y(), 0));
  }
  return axis;
}

// Normals of the grid before it is flipped: S_t x S_theta.
class RevolutionNormals {
 public:
  RevolutionNormals(const Bead& bead, const Axis& axis)
      : bead_(bead), axis_(axis), sign_(bead.right_of_axis() ? -1 : 1) {}

  bool smooth(std::size_t) const { return true; }
  bool smooth_column(std::size_t column) const { return !is_corner(bead_.profile.points[column]); }

  Vector at(std::size_t ring, Side, std::size_t column, Side side) const {
    if (bead_.first_pole && column == 0) return axis_.direction;
    if (bead_.last_pole && column + 1 == bead_.profile.points.size()) return -axis_.direction;
    const ProfilePoint& point = bead_.profile.points[column];
    const Eigen::Vector2d tangent = sign_ * (side == Side::Before ? point.before : point.after);
    return tangent.y() * axis_.radial[ring] - tangent.x() * axis_.direction;
  }

 private:
  const Bead& bead_;
  const Axis& axis_;
  double sign_;
};

// One region for each smooth stretch, the caps by themselves.
std::vector<Region> regions_of(const Bead& bead, std::size_t strips, std::size_t& number) {
  std::vector<Region> regions;
  Bead body = bead;
  auto& points = body.profile.points;
  const std::size_t spans = bead.profile.closed ? points.size() : points.size() - 1;
  if (bead.first_cap) regions.push_back({{0, strips}, {0, 1}, "first cap"});
  if (bead.first_cap) points.erase(points.begin());
  if (bead.last_cap) points.pop_back();
  const std::size_t offset = bead.first_cap ? 1 : 0;
  for (const Range& range : smooth_stretches(body.profile)) {
    regions.push_back(
        {{0, strips}, {range.begin + offset, range.end + offset}, fmt::format("profile {}", ++number)});
  }
  if (bead.last_cap) regions.push_back({{0, strips}, {spans - 1, spans}, "last cap"});
  return regions;
}

void build_bead(const SurfaceTask& task, const Bead& bead, const Axis& axis, std::size_t& number,
                Shell& shell) {
  const auto& points = bead.profile.points;
  Grid grid;
  grid.rings = axis.radial.size();
  grid.columns = points.size();
  grid.rings_wrap = true;
  grid.columns_wrap = bead.profile.closed;
  grid.first_pole = bead.first_pole;
  grid.last_pole = bead.last_pole;
  grid.flip = bead.right_of_axis();
  grid.base = shell.points.size();
  const unsigned threads = task.options.threads;
  const auto position = [&](std::size_t ring, std::size_t column) -> Point {
    const Eigen::Vector2d& p = points[column].position;
    return p.x() * axis.radial[ring] + p.y() * axis.direction;
  };
  append_points(grid, position, threads, shell);
  const std::size_t first_triangle = shell.triangles.size();
  const std::vector<Region> regions = regions_of(bead, grid.strips(), number);
  append_triangles(grid, regions, threads, shell);
  const bool closed = bead.profile.closed || (bead.first_pole && bead.last_pole);
  if (closed && signed_volume(shell, first_triangle) < 0) {
    flip_triangles(shell, first_triangle);
    grid.flip = !grid.flip;
  }
  append_normals(grid, regions, RevolutionNormals(bead, axis), first_triangle, threads, shell);
}

void warn_of_coincidence(const SurfaceTask& task, const std::vector<Bead>& beads) {
  const double distance = kSameFraction * task.profile.size;
  for (std::size_t i = 0; i + 1 < beads.size(); ++i) {
    if (!coincide(beads[i], beads[i + 1], distance)) continue;
    task.warn("the profile is symmetric about the axis: two parts of the surface coincide");
    return;
  }
}

// A closed profile that only touches the axis: the surface has both poles at one place.
bool is_pinched(const Bead& bead) {
  const auto& points = bead.profile.points;
  return bead.first_pole && bead.last_pole && points.front().position == points.back().position;
}

}  // namespace

void build_revolution(const SurfaceTask& task, std::size_t rings, double circle_radius, Shell& shell) {
  const bool revolved = task.surface.kind == SweepSurface::Kind::Revolution;
  std::vector<Bead> beads;
  if (rings >= 3 && !task.profile.degenerate()) {
    beads = split_at_axis(task.profile_curve, task.profile, revolved ? 0 : circle_radius,
                          task.options.corner_angle);
  }
  if (beads.empty()) return;
  if (beads.size() > 1) warn_of_coincidence(task, beads);
  const Axis axis = make_axis(task.surface.kind, rings);
  std::size_t number = 0;
  for (Bead& bead : beads) {
    if (is_pinched(bead))
      task.warn("the profile touches the axis in one point: the surface is pinched there");
    if (task.options.caps && revolved) cap_ends(bead);
    build_bead(task, bead, axis, number, shell);
  }
}

}  // namespace meshcontour::detail
