#include "model/adjacency.hpp"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <utility>

#include "base/large_array.hpp"
#include "meshcontour/error.hpp"
#include "meshcontour/parallel.hpp"

namespace meshcontour::detail {
namespace {

// Points are taken in a few ranges, so that the sides in hand at a time stay few.
constexpr std::size_t kRanges = 4;
constexpr std::size_t kLeastSidesInRange = 1 << 18;

// A side under the lower end of its edge: the higher end above, the side below.
std::uint64_t entry_of(Index high, Index side) {
  return std::uint64_t{high} << 32 | side;
}

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

// Where the sides of a point would begin if all stood in the order of the lower ends of their edges; and,
// behind the last point, where they end.
std::vector<Index> count_sides(std::span<const Triangle> triangles, std::size_t points) {
  std::vector<Index> begin;
  assign_large<Index>(begin, points + 1, 0);
  for_each_side(triangles, [&](Index low, Index, Index) { ++begin[low + 1]; });
  for (std::size_t v = 1; v <= points; ++v) begin[v] += begin[v - 1];
  return begin;
}

// First points of ranges with about as many sides each, and behind them the number of points.
std::vector<Index> split_points(const std::vector<Index>& begin) {
  const std::size_t in_range = std::max<std::size_t>(begin.back() / kRanges + 1, kLeastSidesInRange);
  std::vector<Index> firsts = {0};
  for (std::size_t wanted = in_range; wanted < begin.back(); wanted += in_range) {
    const auto next = std::ranges::lower_bound(begin, wanted) - begin.begin();
    if (static_cast<Index>(next) > firsts.back() && static_cast<std::size_t>(next) + 1 < begin.size()) {
      firsts.push_back(static_cast<Index>(next));
    }
  }
  firsts.push_back(static_cast<Index>(begin.size() - 1));
  return firsts;
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

// Memory for the sides in hand, used by one range after the other: fresh memory costs more than the work on
// it.
class Buffers {
 public:
  std::vector<std::uint64_t> take(std::size_t size) {
    std::vector<std::uint64_t> buffer;
    {
      const std::lock_guard lock(mutex_);
      if (!free_.empty()) {
        buffer = std::move(free_.back());
        free_.pop_back();
      }
    }
    if (buffer.capacity() < size) {
      buffer = {};
      reserve_large(buffer, size + size / 8);
    }
    buffer.resize(size);
    return buffer;
  }

  void give_back(std::vector<std::uint64_t> buffer) {
    const std::lock_guard lock(mutex_);
    free_.push_back(std::move(buffer));
  }

 private:
  std::mutex mutex_;
  std::vector<std::vector<std::uint64_t>> free_;
};

// Pairs the sides whose edges have their lower end in first..last.
std::size_t pair_range(std::span<const Triangle> triangles, std::span<const Index> begin, Index first,
                       Index last, Buffers& buffers, std::vector<Index>& opposite) {
  const Index offset = begin[first];
  std::vector<std::uint64_t> entries = buffers.take(begin[last] - offset);
  std::vector<Index> next(begin.begin() + first, begin.begin() + last);
  for_each_side(triangles, [&](Index low, Index high, Index side) {
    if (low >= first && low < last) entries[next[low - first]++ - offset] = entry_of(high, side);
  });
  std::size_t nonmanifold = 0;
  for (Index v = first; v < last; ++v) {
    const std::size_t size = begin[v + 1] - begin[v];
    if (size > 0) nonmanifold += pair_sides(std::span(entries).subspan(begin[v] - offset, size), opposite);
  }
  buffers.give_back(std::move(entries));
  return nonmanifold;
}

}  // namespace

Adjacency side_adjacency(std::span<const Triangle> triangles, std::size_t points, unsigned threads) {
  if (triangles.size() >= kManySides / 3) {
    throw Error(ErrorCode::OutOfMemory, "a shell has more triangles than can be connected");
  }
  const std::vector<Index> begin = count_sides(triangles, points), firsts = split_points(begin);
  Adjacency result;
  assign_large(result.opposite, 3 * triangles.size(), kNoSide);
  std::atomic<std::size_t> nonmanifold = 0;
  Buffers buffers;
  parallel_for(firsts.size() - 1, 1, threads, [&](std::size_t first_range, std::size_t last_range) {
    for (std::size_t r = first_range; r < last_range; ++r) {
      nonmanifold += pair_range(triangles, begin, firsts[r], firsts[r + 1], buffers, result.opposite);
    }
  });
  result.nonmanifold_edges = nonmanifold;
  return result;
}

}  // namespace meshcontour::detail
