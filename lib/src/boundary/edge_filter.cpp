#include "boundary/edge_filter.hpp"

#include <algorithm>
#include <array>
#include <bit>

namespace meshcontour::detail {
namespace {

constexpr std::size_t kTableTriangles = 200;  // up to here a table of all edges is faster than the filter
constexpr std::size_t kTableSlots = 2048;

// How often an edge occurs from its smaller to its larger end, and back.
struct Uses {
  std::uint32_t up = 0, down = 0;
};

void add_edge(std::uint64_t low, std::uint64_t high, Uses uses, EdgeCensus& census) {
  const std::uint32_t count = uses.up + uses.down;
  if (count >= 3) ++census.nonmanifold;
  if (count == 2 && uses.up != 1) ++census.inconsistent;
  if (count != 1) return;
  const auto a = static_cast<Index>(low), b = static_cast<Index>(high);
  census.boundary.push_back(uses.up ? BoundaryEdge{a, b} : BoundaryEdge{b, a});
}

// Counts every edge in a small hash table.
class EdgeTable {
 public:
  explicit EdgeTable(std::size_t triangles)
      : size_(std::bit_ceil(6 * triangles + 1)), shift_(64 - std::countr_zero(size_)) {
    std::fill_n(keys_.begin(), size_, 0);
  }

  void add(Index from, Index to) {
    const bool up = from < to;
    const std::uint64_t key = up ? pack(from, to) : pack(to, from);
    std::size_t slot = (key * 0x9e3779b97f4a7c15u) >> shift_;
    while (keys_[slot] != key) {
      if (keys_[slot] == 0) {
        keys_[slot] = key;
        uses_[slot] = {};
        break;
      }
      slot = (slot + 1) & (size_ - 1);
    }
    uses_[slot].up += up;
    uses_[slot].down += !up;
  }

  void collect(EdgeCensus& census) const {
    for (std::size_t i = 0; i < size_; ++i) {
      if (keys_[i] != 0) add_edge(keys_[i] >> 32, keys_[i] & 0xffffffffu, uses_[i], census);
    }
  }

 private:
  // Never zero: high > low.
  static std::uint64_t pack(Index low, Index high) { return (std::uint64_t{low} << 32) | high; }

  std::size_t size_;
  int shift_;
  std::array<std::uint64_t, kTableSlots> keys_;
  std::array<Uses, kTableSlots> uses_;
};

void count_in_table(std::span<const Triangle> triangles, EdgeCensus& census) {
  EdgeTable table(triangles.size());
  for (const Triangle& t : triangles) {
    if (degenerate(t)) continue;
    for (std::size_t k = 0; k < 3; ++k) table.add(t[k], t[(k + 1) % 3]);
  }
  table.collect(census);
}

// After this a sum is zero unless some edge at its vertex is not used as often in one direction as in the
// other. Degenerate triangles add nothing.
void add_fingerprints(std::span<const Triangle> triangles, std::uint64_t* sums) {
  for (const auto& [a, b, c] : triangles) {
    const std::uint64_t ha = mix(a), hb = mix(b), hc = mix(c);
    sums[a] += hb - hc;
    sums[b] += hc - ha;
    sums[c] += ha - hb;
  }
}

// Edges with both ends marked, as (low, high, runs down) in 32 + 31 + 1 bits.
std::vector<std::uint64_t> marked_edges(std::span<const Triangle> triangles, const std::uint64_t* sums) {
  std::vector<std::uint64_t> marked;
  const auto add = [&](Index from, Index to) {
    const bool down = from > to;
    const std::uint64_t low = down ? to : from, high = down ? from : to;
    marked.push_back(low << 32 | high << 1 | std::uint64_t{down});
  };
  for (const Triangle& t : triangles) {
    const auto& [a, b, c] = t;
    const bool at_a = sums[a] != 0, at_b = sums[b] != 0, at_c = sums[c] != 0;
    if (at_a + at_b + at_c < 2 || degenerate(t)) continue;
    if (at_a && at_b) add(a, b);
    if (at_b && at_c) add(b, c);
    if (at_c && at_a) add(c, a);
  }
  return marked;
}

void count_marked(std::span<const Triangle> triangles, std::uint64_t* sums, EdgeCensus& census) {
  add_fingerprints(triangles, sums);
  std::vector<std::uint64_t> marked = marked_edges(triangles, sums);
  std::ranges::sort(marked);
  for (std::size_t i = 0; i < marked.size();) {
    const std::uint64_t low = marked[i] >> 32, high = (marked[i] >> 1) & 0x7fffffffu;
    Uses uses;
    std::size_t end = i;
    for (; end < marked.size() && marked[end] >> 1 == marked[i] >> 1; ++end) {
      (marked[end] & 1 ? uses.down : uses.up) += 1;
    }
    add_edge(low, high, uses, census);
    sums[low] = sums[high] = 0;  // every vertex whose sum is not zero is an end of one of these edges
    i = end;
  }
}

}  // namespace

EdgeCensus census_of_edges(std::span<const Triangle> triangles, std::size_t vertex_bound,
                           Workspace& workspace) {
  EdgeCensus census;
  if (triangles.size() <= kTableTriangles) {
    count_in_table(triangles, census);
  } else {
    workspace.sums.reserve(vertex_bound);
    count_marked(triangles, workspace.sums.data(), census);
  }
  std::ranges::sort(census.boundary);
  return census;
}

}  // namespace meshcontour::detail
