#include "boundary/small_patch.hpp"

#include <array>
#include <bit>

#include "boundary/edge_filter.hpp"

namespace meshcontour::detail {
namespace {

using Bits = std::uint64_t;   // one a vertex of the patch
using Number = std::uint8_t;  // of a vertex in the patch

constexpr std::size_t kMost = 64;

constexpr Bits bit(std::size_t i) {
  return Bits{1} << i;
}

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
      twice |= (leaving_[a] & bit(b)) | (leaving_[b] & bit(c)) | (leaving_[c] & bit(a));
      leaving_[a] |= bit(b);
      leaving_[b] |= bit(c);
      leaving_[c] |= bit(a);
      arriving_[b] |= bit(a);
      arriving_[c] |= bit(b);
      arriving_[a] |= bit(c);
    }
    return twice == 0;
  }

  // Finds the one boundary edge that leaves each boundary vertex; false if some vertex has two.
  bool find_boundary() {
    for (std::size_t v = 0; v < count_; ++v) {
      const Bits out = leaving_[v] & ~arriving_[v], in = arriving_[v] & ~leaving_[v];
      if (((out & (out - 1)) | (in & (in - 1))) != 0) return false;
      if (out == 0) continue;
      next_[v] = static_cast<Number>(std::countr_zero(out));
      boundary_[size_++] = static_cast<Number>(v);
    }
    sort_boundary();
    return true;
  }

  void write(PatchBoundary& result) {
    if (size_ == 0) return;
    result.vertex_count = size_;
    result.edges.reserve(size_);
    for (std::size_t i = 0; i < size_; ++i) {
      result.edges.push_back({vertices_[boundary_[i]], vertices_[next_[boundary_[i]]]});
    }
    write_loops(result.loops);
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
    leaving_[count_] = arriving_[count_] = 0;
    slots[v] = static_cast<Index>(count_);
    return count_++;
  }

  // By vertex. Each finds its place by counting the smaller ones, which for so few is faster than comparing
  // and moving.
  void sort_boundary() {
    std::array<std::int32_t, kMost> keys{};
    for (std::size_t i = 0; i < size_; ++i) keys[i] = static_cast<std::int32_t>(vertices_[boundary_[i]]);
    std::array<Number, kMost> sorted;
    for (std::size_t i = 0; i < size_; ++i) {
      std::int32_t place = 0;
      for (std::size_t k = 0; k < size_; ++k) place += keys[k] < keys[i] ? 1 : 0;
      sorted[static_cast<std::size_t>(place)] = boundary_[i];
    }
    boundary_ = sorted;
  }

  void write_loops(std::vector<BoundaryLoop>& loops) {
    std::array<Index, kMost> path;
    std::array<std::size_t, kMost> ends;
    std::size_t length = 0, count = 0;
    Bits open = 0;
    for (std::size_t i = 0; i < size_; ++i) open |= bit(boundary_[i]);
    for (std::size_t i = 0; open != 0; ++i) {
      if ((open & bit(boundary_[i])) == 0) continue;
      for (std::size_t v = boundary_[i]; (open & bit(v)) != 0; v = next_[v]) {
        open &= ~bit(v);
        path[length++] = vertices_[v];
      }
      ends[count++] = length;
    }
    loops.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      loops.push_back({{path.data() + (i == 0 ? 0 : ends[i - 1]), path.data() + ends[i]}, true});
    }
  }

  std::size_t count_ = 0;  // of vertices
  std::size_t size_ = 0;   // of boundary vertices, or edges
  std::array<Index, kMost> vertices_;
  std::array<Bits, kMost> leaving_, arriving_;  // bit w of v: an edge runs from v to w, from w to v
  std::array<Number, kMost> next_, boundary_;
};

}  // namespace

bool small_patch_boundary(std::span<const Triangle> triangles, std::size_t vertex_bound, Workspace& workspace,
                          PatchBoundary& boundary) {
  if (triangles.size() > kSmallPatchTriangles) return false;
  workspace.slots.reserve(vertex_bound);
  SmallPatch patch;
  if (!patch.add(triangles, workspace.slots.data()) || !patch.find_boundary()) return false;
  patch.write(boundary);
  return true;
}

}  // namespace meshcontour::detail
