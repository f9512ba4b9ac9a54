#include "model/fans.hpp"

#include <atomic>

#include "base/large_array.hpp"
#include "meshcontour/error.hpp"
#include "meshcontour/parallel.hpp"
#include "model/point_attributes.hpp"

namespace meshcontour::detail {
namespace {

constexpr std::size_t kPointsAtATime = 1 << 15;

// The side by which a walk round `point` leaves the triangle that it enters by `side`.
Index leave(std::span<const Triangle> triangles, Index side, Index point) {
  return side_start(triangles, side) == point ? previous_side(side) : next_side(side);
}

// Corners of a fan are named by the side that starts there. Calls visit(corner) for those that follow
// `corner` in the direction of `side`, one of the two sides at it; returns true when the walk came round to
// where it began.
template <typename Connected, typename Visit>
bool walk_fan(std::span<const Triangle> triangles, const Adjacency& adjacency, Index corner, Index side,
              Connected&& connected, Visit&& visit) {
  const Index point = side_start(triangles, corner);
  while (connected(side)) {
    const Index entered = adjacency.opposite[side];
    const Index here = side_start(triangles, entered) == point ? entered : next_side(entered);
    if (here == corner) return true;
    visit(here);
    side = leave(triangles, entered, point);
  }
  return false;
}

// Visits the fan of a corner, but not the corner itself.
template <typename Connected, typename Visit>
void for_fan(std::span<const Triangle> triangles, const Adjacency& adjacency, Index corner,
             Connected&& connected, Visit&& visit) {
  if (walk_fan(triangles, adjacency, corner, corner, connected, visit)) return;
  walk_fan(triangles, adjacency, corner, previous_side(corner), connected, visit);
}

struct PointUse {
  Index corner = kNoSide;  // the first
  Index count = 0;         // triangles at the point
};

}  // namespace

std::size_t count_bow_ties(const Shell& shell, const Adjacency& adjacency, unsigned threads) {
  const std::span<const Triangle> triangles = shell.triangles;
  std::vector<PointUse> uses;
  assign_large(uses, shell.points.size(), PointUse{});
  for (Index corner = 0; corner < adjacency.opposite.size(); ++corner) {
    PointUse& use = uses[side_start(triangles, corner)];
    if (use.count++ == 0) use.corner = corner;
  }
  for (Index side = 0; side < adjacency.opposite.size(); ++side) {
    if (adjacency.opposite[side] != kManySides) continue;
    uses[side_start(triangles, side)].count = 0;
    uses[side_end(triangles, side)].count = 0;
  }
  std::atomic<std::size_t> bow_ties = 0;
  const auto connected = [&](Index side) { return is_paired(adjacency.opposite[side]); };
  parallel_for(uses.size(), kPointsAtATime, threads, [&](std::size_t begin, std::size_t end) {
    std::size_t found = 0;
    for (std::size_t v = begin; v < end; ++v) {
      if (uses[v].count < 2) continue;
      Index in_fan = 1;
      for_fan(triangles, adjacency, uses[v].corner, connected, [&](Index) { ++in_fan; });
      found += in_fan == uses[v].count ? 0 : 1;
    }
    bow_ties += found;
  });
  return bow_ties;
}

std::size_t split_fans(Shell& shell, const Adjacency& adjacency) {
  const std::vector<Triangle> triangles = shell.triangles;
  const std::size_t original = shell.points.size();
  std::vector<std::uint8_t> seen(adjacency.opposite.size(), 0), taken(original, 0);
  const auto connected = [&](Index side) {
    const Index other = adjacency.opposite[side];
    return is_paired(other) && side_start(triangles, side) != side_start(triangles, other);
  };
  for (Index corner = 0; corner < seen.size(); ++corner) {
    if (seen[corner] != 0) continue;
    const Index point = side_start(triangles, corner);
    Index copy = point;
    if (taken[point] != 0) {
      if (shell.points.size() >= kManySides)
        throw Error(ErrorCode::OutOfMemory, "too many points to cut apart");
      copy = static_cast<Index>(shell.points.size());
      shell.points.push_back(Point(shell.points[point]));
      resize_point_attributes(shell);
      copy_point_attributes(shell, point, copy);
    }
    taken[point] = 1;
    const auto assign = [&](Index at) {
      seen[at] = 1;
      shell.triangles[at / 3][at % 3] = copy;
    };
    assign(corner);
    for_fan(triangles, adjacency, corner, connected, assign);
  }
  return shell.points.size() - original;
}

}  // namespace meshcontour::detail
