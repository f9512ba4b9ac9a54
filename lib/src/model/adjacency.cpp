#include "model/adjacency.hpp"

#include <algorithm>
#include <atomic>

#include "meshcontour/error.hpp"
#include "meshcontour/parallel.hpp"

namespace meshcontour::detail {
namespace {

constexpr std::size_t kPointsAtATime = 1 << 15;

// A side under the lower end of its edge: the higher end above, the side below.
std::uint64_t entry_of(Index high, Index side) {
  return std::uint64_t{high} << 32 | side;
}

// Sides grouped by the lower end of their edge: those of point v stand at [begin[v], begin[v + 1]).
struct SidesByPoint {
  std::vector<Index> begin;
  std::vector<std::uint64_t> entries;
};

template <typename Visit>
void for_each_side(std::span<const Triangle> triangles, Visit&& visit) {
  Index side = 0;
  for (const Triangle& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k, ++side) {
      const Index from = t[k], to = t[k == 2 ? 0 : k + 1];
      if (from != to) visit(std::min(from, to), std::max(from, to), side);
    }
  }
}

SidesByPoint group_sides(std::span<const Triangle> triangles, std::size_t points) {
  SidesByPoint groups;
  groups.begin.assign(points + 2, 0);
  for_each_side(triangles, [&](Index low, Index, Index) { ++groups.begin[low + 2]; });
  for (std::size_t v = 2; v < groups.begin.size(); ++v) groups.begin[v] += groups.begin[v - 1];
  groups.entries.resize(groups.begin.back());
  for_each_side(triangles, [&](Index low, Index high, Index side) {
    groups.entries[groups.begin[low + 1]++] = entry_of(high, side);
  });
  return groups;
}

void sort_entries(std::span<std::uint64_t> entries) {
  if (entries.size() > 24) {
    std::ranges::sort(entries);
    return;
  }
  for (std::size_t i = 1; i < entries.size(); ++i) {
    const std::uint64_t entry = entries[i];
    std::size_t k = i;
    for (; k > 0 && entries[k - 1] > entry; --k) entries[k] = entries[k - 1];
    entries[k] = entry;
  }
}

// Pairs the sides of one point; returns the edges with three or more.
std::size_t pair_sides(std::span<std::uint64_t> entries, std::vector<Index>& opposite) {
  sort_entries(entries);
  std::size_t nonmanifold = 0;
  for (std::size_t i = 0; i < entries.size();) {
    std::size_t end = i + 1;
    while (end < entries.size() && entries[end] >> 32 == entries[i] >> 32) ++end;
    const auto side = [&](std::size_t k) { return static_cast<Index>(entries[k]); };
    if (end - i == 2) {
      opposite[side(i)] = side(i + 1);
      opposite[side(i + 1)] = side(i);
    } else if (end - i > 2) {
      for (std::size_t k = i; k < end; ++k) opposite[side(k)] = kManySides;
      ++nonmanifold;
    }
    i = end;
  }
  return nonmanifold;
}

}  // namespace

Adjacency side_adjacency(std::span<const Triangle> triangles, std::size_t points, unsigned threads) {
  if (triangles.size() >= kManySides / 3) {
    throw Error(ErrorCode::OutOfMemory, "a shell has more triangles than can be connected");
  }
  SidesByPoint groups = group_sides(triangles, points);
  Adjacency result;
  result.opposite.assign(3 * triangles.size(), kNoSide);
  std::atomic<std::size_t> nonmanifold = 0;
  parallel_for(points, kPointsAtATime, threads, [&](std::size_t first, std::size_t last) {
    std::size_t found = 0;
    for (std::size_t v = first; v < last; ++v) {
      const std::size_t begin = groups.begin[v], size = groups.begin[v + 1] - begin;
      if (size > 0) found += pair_sides(std::span(groups.entries).subspan(begin, size), result.opposite);
    }
    nonmanifold += found;
  });
  result.nonmanifold_edges = nonmanifold;
  return result;
}

}  // namespace meshcontour::detail
