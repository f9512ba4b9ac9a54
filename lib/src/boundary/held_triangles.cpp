#include "boundary/held_triangles.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include "boundary/edge_filter.hpp"
#include "boundary/local_patch.hpp"
#include "model/adjacency.hpp"
#include "model/fans.hpp"

namespace meshcontour::detail {
namespace {

// The side that runs from one vertex to another.
class SideTable {
 public:
  explicit SideTable(std::size_t triangles)
      : entries_(std::bit_ceil(6 * triangles + 2)), shift_(64 - std::countr_zero(entries_.size())) {}

  Index find(Index from, Index to) const { return entries_[slot(pack(from, to))].side; }

  void add(Index from, Index to, Index side) {
    const std::uint64_t key = pack(from, to);
    entries_[slot(key)] = {key, side};
  }

 private:
  struct Entry {
    std::uint64_t key = 0;
    Index side = kNoSide;
  };

  static std::uint64_t pack(Index from, Index to) { return std::uint64_t{from} << 32 | to; }

  // Where the key is, or would be put.
  std::size_t slot(std::uint64_t key) const {
    std::size_t i = mix(key) >> shift_;
    while (entries_[i].side != kNoSide && entries_[i].key != key) i = (i + 1) & (entries_.size() - 1);
    return i;
  }

  std::vector<Entry> entries_;
  int shift_;
};

// Takes triangles one by one.
class Holder {
 public:
  Holder(const Shell& shell, std::size_t count) : shell_(shell), table_(count) {}

  bool take(std::size_t source, bool flip) {
    Triangle t = shell_.triangles[source];
    if (flip) std::swap(t[1], t[2]);
    if (degenerate(t)) return false;
    for (std::size_t k = 0; k < 3; ++k) {
      if (table_.find(t[k], t[(k + 1) % 3]) != kNoSide) return false;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const auto side = static_cast<Index>(held_.opposite.size());
      const Index other = table_.find(t[(k + 1) % 3], t[k]);
      table_.add(t[k], t[(k + 1) % 3], side);
      held_.opposite.push_back(other);
      if (other != kNoSide) held_.opposite[other] = side;
    }
    held_.triangles.push_back(t);
    held_.sources.push_back(source);
    held_.flipped.push_back(flip);
    return true;
  }

  HeldTriangles finish() { return std::move(held_); }

 private:
  const Shell& shell_;
  SideTable table_;
  HeldTriangles held_;
};

HeldTriangles hold_as_given(const Shell& shell, std::size_t first, std::size_t count) {
  Holder holder(shell, count);
  std::size_t rejected = 0;
  for (std::size_t i = first; i < first + count; ++i) rejected += holder.take(i, false) ? 0 : 1;
  HeldTriangles held = holder.finish();
  held.rejected_as_given = rejected;
  return held;
}

HeldTriangles hold_oriented(const Shell& shell, std::size_t first, const std::vector<bool>& turned) {
  Holder holder(shell, turned.size());
  std::vector<std::size_t> unheld;
  for (std::size_t i = 0; i < turned.size(); ++i) {
    if (!holder.take(first + i, turned[i]) && !holder.take(first + i, !turned[i]))
      unheld.push_back(first + i);
  }
  HeldTriangles held = holder.finish();
  held.unheld = std::move(unheld);
  return held;
}

// Gives every fan a vertex of its own.
void separate_fans(const Shell& shell, HeldTriangles& held, ZeroedArray<Index>& slots) {
  LocalPatch local = number_locally(held.triangles, shell.points.size(), slots);
  Shell apart;
  apart.points.resize(local.vertices.size(), Point::Zero());
  apart.triangles = local.triangles;
  Adjacency adjacency{std::move(held.opposite), 0};
  split_fans(apart, adjacency);
  held.opposite = std::move(adjacency.opposite);
  held.vertices.resize(apart.points.size());
  for (std::size_t i = 0; i < local.triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k)
      held.vertices[apart.triangles[i][k]] = local.vertices[local.triangles[i][k]];
  }
  held.triangles = std::move(apart.triangles);
}

}  // namespace

HeldTriangles hold_triangles(const Shell& shell, std::size_t first, std::size_t count,
                             ZeroedArray<Index>& slots) {
  if (count >= kManySides / 3) {
    throw Error(ErrorCode::OutOfMemory, "a patch has more triangles than a halfedge mesh can number");
  }
  HeldTriangles held = hold_as_given(shell, first, count);
  if (held.rejected_as_given > 0) {
    const auto triangles = std::span(shell.triangles).subspan(first, count);
    const LocalPatch all = number_locally(triangles, shell.points.size(), slots);
    const std::size_t rejected = held.rejected_as_given;
    held = hold_oriented(shell, first, turned_triangles(shell, all));
    held.rejected_as_given = rejected;
  }
  separate_fans(shell, held, slots);
  return held;
}

}  // namespace meshcontour::detail
