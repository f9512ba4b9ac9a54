#include "boundary/edge_filter.hpp"

#include <algorithm>
#include <array>
#include <bit>

namespace meshcontour::detail {
namespace {

constexpr std::size_t kTableTriangles = 200;  // up to here a table of all edges is faster than the filter
constexpr std::size_t kTableSlots = 2048;
constexpr std::size_t kFewTriangles = 1 << 15;  // up to here the sums of a patch stay in a fast cache

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
  const auto add = [sums](const Triangle& t) {
    const auto& [a, b, c] = t;
    const std::uint64_t ha = mix(a), hb = mix(b), hc = mix(c);
    sums[a] += hb - hc;
    sums[b] += hc - ha;
    sums[c] += ha - hb;
  };
  // Triangles in no order find sums that are many in slow memory, unless they are asked for ahead of time.
  const std::size_t ahead =
      std::min<std::size_t>(triangles.size(), triangles.size() > kFewTriangles ? 16 : kFewTriangles);
  for (std::size_t i = 0; i + ahead < triangles.size(); ++i) {
    for (const Index v : triangles[i + ahead]) __builtin_prefetch(sums + v, 1);
    add(triangles[i]);
  }
  for (const Triangle& t : triangles.last(ahead)) add(t);
}

// An edge as (low, high, runs down) in 32 + 31 + 1 bits.
void push_edge(Index from, Index to, std::vector<std::uint64_t>& edges) {
  const bool down = from > to;
  const std::uint64_t low = down ? to : from, high = down ? from : to;
  edges.push_back(low << 32 | high << 1 | std::uint64_t{down});
}

// Appends the edges with both ends marked.
template <class IsMarked>
void push_marked_edges(std::span<const Triangle> triangles, const IsMarked& is_marked,
                       std::vector<std::uint64_t>& edges) {
  for (const Triangle& t : triangles) {
    const auto& [a, b, c] = t;
    const bool at_a = is_marked(a), at_b = is_marked(b), at_c = is_marked(c);
    if (at_a + at_b + at_c < 2 || degenerate(t)) continue;
    if (at_a && at_b) push_edge(a, b, edges);
    if (at_b && at_c) push_edge(b, c, edges);
    if (at_c && at_a) push_edge(c, a, edges);
  }
}

// One bit a vertex: whether its sum is not zero. Returns whether any is set.
bool pack_marks(std::span<const std::uint64_t> sums, std::vector<std::uint64_t>& marks) {
  marks.assign((sums.size() + 63) / 64, 0);
  std::uint64_t any = 0;
  for (std::size_t word = 0; word < marks.size(); ++word) {
    const auto part = sums.subspan(64 * word, std::min<std::size_t>(64, sums.size() - 64 * word));
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < part.size(); ++i) bits |= std::uint64_t{part[i] != 0} << i;
    any |= marks[word] = bits;
  }
  return any != 0;
}

// Fills workspace.edges with those that may be unbalanced, used more often in one direction than in the
// other.
void filter_edges(std::span<const Triangle> triangles, std::size_t vertex_bound, Workspace& workspace) {
  workspace.sums.reserve(vertex_bound);
  const std::uint64_t* sums = workspace.sums.data();
  add_fingerprints(triangles, workspace.sums.data());
  workspace.edges.clear();
  if (vertex_bound > 4 * triangles.size()) {
    push_marked_edges(
        triangles, [sums](Index v) { return sums[v] != 0; }, workspace.edges);
  } else if (pack_marks({sums, vertex_bound}, workspace.marks)) {
    // Bits stay in a fast cache where the sums would not.
    const std::uint64_t* marks = workspace.marks.data();
    push_marked_edges(
        triangles, [marks](Index v) { return (marks[v / 64] >> v % 64 & 1) != 0; }, workspace.edges);
  }
}

// Sorts edges and counts equal ones.
void count_edges(std::vector<std::uint64_t>& edges, EdgeCensus& census) {
  std::ranges::sort(edges);
  for (std::size_t i = 0; i < edges.size();) {
    Uses uses;
    std::size_t end = i;
    for (; end < edges.size() && edges[end] >> 1 == edges[i] >> 1; ++end) {
      (edges[end] & 1 ? uses.down : uses.up) += 1;
    }
    add_edge(edges[i] >> 32, edges[i] >> 1 & 0x7fffffffu, uses, census);
    i = end;
  }
}

void count_filtered(std::span<const Triangle> triangles, std::size_t vertex_bound, Workspace& workspace) {
  filter_edges(triangles, vertex_bound, workspace);
  EdgeCensus& census = workspace.census;
  count_edges(workspace.edges, census);
  for (const std::uint64_t edge : workspace.edges) {
    // Every vertex whose sum is not zero is an end of one of these.
    workspace.sums[edge >> 32] = workspace.sums[edge >> 1 & 0x7fffffffu] = 0;
  }
  if (census.nonmanifold + census.inconsistent == 0) return;
  // A dirty patch: look at the balanced edges too.
  census = {};
  workspace.edges.clear();
  push_marked_edges(
      triangles, [](Index) { return true; }, workspace.edges);
  count_edges(workspace.edges, census);
}

}  // namespace

const EdgeCensus& census_of_edges(std::span<const Triangle> triangles, std::size_t vertex_bound,
                                  Workspace& workspace) {
  EdgeCensus& census = workspace.census;
  census.boundary.clear();
  census.nonmanifold = census.inconsistent = 0;
  if (triangles.size() <= kTableTriangles) {
    count_in_table(triangles, census);
  } else {
    count_filtered(triangles, vertex_bound, workspace);
  }
  std::ranges::sort(census.boundary);
  return census;
}

}  // namespace meshcontour::detail
