#pragma once

#include <cassert>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "base/large_array.hpp"
#include "boundary/array_blocks.hpp"
#include "meshcontour/boundary.hpp"

namespace meshcontour::detail {

/// An array that starts as zeros without touching its pages, so that a sparse use of a large one costs
/// little.
template <class Number>
class ZeroedArray {
 public:
  /// At least `size` elements. Growing zeroes everything.
  void reserve(std::size_t size) {
    if (size <= size_) return;
    memory_ = {};
    size_ = 0;
    memory_ = ZeroedMemory(size * sizeof(Number));
    size_ = size;
  }

  Number* data() { return static_cast<Number*>(memory_.data()); }
  Number& operator[](std::size_t i) {
    assert(i < size_);
    return data()[i];
  }

 private:
  ZeroedMemory memory_;
  std::size_t size_ = 0;
};

/// The edges of a patch that are not shared by just two triangles running in opposite directions.
struct EdgeCensus {
  std::vector<BoundaryEdge> boundary;  ///< exactly one triangle; sorted by (from, to)
  std::size_t nonmanifold = 0;         ///< three or more triangles
  std::size_t inconsistent = 0;        ///< two triangles that run the same way
};

/// Memory that one thread keeps from patch to patch. Cost a patch: the patch alone, however large its shell.
struct Workspace {
  ZeroedArray<std::uint64_t> sums;  ///< one a vertex of the shell; all zero between patches
  ZeroedArray<Index> slots;         ///< one a vertex of the shell; a hint to be checked, so never reset
  EdgeCensus census;                ///< of the last patch
  std::vector<std::uint64_t> edges, marks;  ///< scratch of the edge filter
  std::vector<BoundaryLoop> loops;          ///< scratch of small patches
  ArrayBlocks<BoundaryEdge> edge_arrays;    ///< the memory of results
  ArrayBlocks<BoundaryLoop> loop_arrays;
  ArrayBlocks<Index> vertex_arrays;
};

/// Hands out workspaces to the parts of a parallel loop; at most one a thread is made.
class WorkspacePool {
 public:
  template <class Body>
  void with(const Body& body) {
    auto workspace = take();
    body(*workspace);
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(workspace));
  }

 private:
  std::unique_ptr<Workspace> take() {
    const std::lock_guard lock(mutex_);
    if (idle_.empty()) return std::make_unique<Workspace>();
    auto workspace = std::move(idle_.back());
    idle_.pop_back();
    return workspace;
  }

  std::mutex mutex_;
  std::vector<std::unique_ptr<Workspace>> idle_;
};

}  // namespace meshcontour::detail
