#include "boundary/small_patch.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#include "boundary/edge_filter.hpp"

namespace meshcontour::detail {
namespace {

using Bits = std::uint64_t;   // one a vertex of the patch
using Number = std::uint8_t;  // of a vertex in the patch

constexpr std::size_t kMost = 64;

constexpr Bits bit(std::size_t i) {
  return Bits{1} << i;
}

// The directed edges at a vertex, a bit for the vertex at the other end of each.
struct Row {
  Bits leaving, arriving;
};

// The directed edges of a patch as two 64 x 64 matrices of bits.
class SmallPatch {
 public:
  // False if there are too many vertices or some edge is run twice in one direction.
  bool add(std::span<const Triangle> triangles, Index* slots) {
    Bits twice = 0;
    for (const Triangle& t : triangles) {
      const std::size_t a = number(t[0], slots), b = number(t[1], slots), c = number(t[2], slots);
      if (count_ > kMost) return false;
      if (a == b || b == c || c == a) continue;
      twice |= join(a, bit(b), bit(c)) | join(b, bit(c), bit(a)) | join(c, bit(a), bit(b));
    }
    return twice == 0;
  }

  // Finds the one boundary edge that leaves each boundary vertex; false if some vertex has two.
  bool find_boundary() {
    Bits several = 0;
    for (std::size_t v = 0; v < count_; ++v) {
      const Bits out = rows_[v].leaving & ~rows_[v].arriving, in = rows_[v].arriving & ~rows_[v].leaving;
      several |= (out & (out - 1)) | (in & (in - 1));
      open_ |= Bits{out != 0} << v;
      next_[v] = static_cast<Number>(std::countr_zero(out));
    }
    return several == 0;
  }

  void write(Workspace& workspace, PatchBoundary& result) {
    if (open_ == 0) return;
    sort_boundary();
    std::array<BoundaryEdge, kMost> edges;
    for (std::size_t i = 0; i < size_; ++i) {
      edges[i] = {vertices_[boundary_[i]], vertices_[next_[boundary_[i]]]};
    }
    result.vertex_count = size_;
    result.edges = workspace.edge_arrays.make({edges.data(), size_});
    write_loops(workspace, result);
  }

 private:
  std::size_t number(Index v, Index* slots) {
    const std::size_t slot = slots[v];
    if (slot < count_ && vertices_[slot] == v) return slot;
    if (count_ >= kMost) {
      count_ = kMost + 1;
      return 0;
    }
    vertices_[count_] = v;
    rows_[count_] = {0, 0};
    slots[v] = static_cast<Index>(count_);
    return count_++;
  }

  // Adds a corner's two edges; returns what was there already.
  Bits join(std::size_t corner, Bits next, Bits previous) {
    Row& row = rows_[corner];
    const Bits before = row.leaving & next;
    row.leaving |= next;
    row.arriving |= previous;
    return before;
  }

  // The boundary by vertex.
  void sort_boundary() {
    Index least = std::numeric_limits<Index>::max(), most = 0;
    for (std::size_t v = 0; v < count_; ++v) {
      least = std::min(least, vertices_[v]);
      most = std::max(most, vertices_[v]);
    }
    if (most - least < 64 * kMost) {
      sort_by_bits(least, most);
    } else {
      sort_by_ranks();
    }
  }

  // Marks the vertices in a set of bits and reads it from the low end.
  void sort_by_bits(Index least, Index most) {
    std::array<Bits, kMost> marks;
    const std::size_t words = (most - least) / 64 + 1;
    std::fill_n(marks.begin(), words, 0);
    std::array<Number, 64 * kMost> holder;  // set where the vertex is marked
    for (Bits open = open_; open != 0; open &= open - 1) {
      const auto v = static_cast<std::size_t>(std::countr_zero(open));
      const std::size_t place = vertices_[v] - least;
      marks[place / 64] |= bit(place % 64);
      holder[place] = static_cast<Number>(v);
    }
    for (std::size_t word = 0; word < words; ++word) {
      for (Bits rest = marks[word]; rest != 0; rest &= rest - 1) {
        boundary_[size_++] = holder[64 * word + static_cast<std::size_t>(std::countr_zero(rest))];
      }
    }
  }

  // Each finds its place by counting the smaller ones, which for so few is faster than comparing and moving.
  // Numbers with a sign are compared several at once; the flipped bit keeps the order.
  void sort_by_ranks() {
    std::array<Number, kMost> numbers;
    std::array<std::int32_t, kMost> keys;
    for (Bits open = open_; open != 0; open &= open - 1) {
      numbers[size_] = static_cast<Number>(std::countr_zero(open));
      keys[size_] = static_cast<std::int32_t>(vertices_[numbers[size_]] ^ 0x80000000U);
      ++size_;
    }
    for (std::size_t i = 0; i < size_; ++i) {
      std::int32_t place = 0;
      for (std::size_t k = 0; k < size_; ++k) place += keys[k] < keys[i] ? 1 : 0;
      boundary_[static_cast<std::size_t>(place)] = numbers[i];
    }
  }

  void write_loops(Workspace& workspace, PatchBoundary& result) {
    std::array<Index, kMost> path;
    std::vector<BoundaryLoop>& loops = workspace.loops;
    loops.clear();
    for (std::size_t i = 0; open_ != 0; ++i) {
      if ((open_ & bit(boundary_[i])) == 0) continue;
      std::size_t length = 0;
      for (std::size_t v = boundary_[i]; (open_ & bit(v)) != 0; v = next_[v]) {
        open_ &= ~bit(v);
        path[length++] = vertices_[v];
      }
      loops.push_back({workspace.vertex_arrays.make({path.data(), length}), true});
    }
    result.loops = workspace.loop_arrays.make(loops);
  }

  std::size_t count_ = 0;  // of vertices
  std::size_t size_ = 0;   // of boundary vertices, or edges
  Bits open_ = 0;          // boundary vertices that no loop has
  std::array<Index, kMost> vertices_;
  std::array<Row, kMost> rows_;
  std::array<Number, kMost> next_, boundary_;
};

}  // namespace

bool small_patch_boundary(std::span<const Triangle> triangles, std::size_t vertex_bound, Workspace& workspace,
                          PatchBoundary& boundary) {
  if (triangles.size() > kSmallPatchTriangles) return false;
  workspace.slots.reserve(vertex_bound);
  SmallPatch patch;
  if (!patch.add(triangles, workspace.slots.data()) || !patch.find_boundary()) return false;
  patch.write(workspace, boundary);
  return true;
}

}  // namespace meshcontour::detail
