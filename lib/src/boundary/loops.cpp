#include "boundary/loops.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "boundary/fans.hpp"

namespace meshcontour::detail {
namespace {

// Looks up the edges that leave a vertex. A slot is a hint, right or stale, checked against the edges.
class EdgesByStart {
 public:
  EdgesByStart(std::span<const BoundaryEdge> edges, std::size_t vertex_bound, ZeroedArray<Index>& slots)
      : edges_(edges), slots_(slots) {
    slots_.reserve(vertex_bound);
    for (std::size_t i = 0; i < edges.size(); ++i) slots_[edges[i].from] = static_cast<Index>(i);
  }

  /// An edge that leaves v, or the number of edges.
  std::size_t find(Index v) {
    const std::size_t i = slots_[v];
    return i < edges_.size() && edges_[i].from == v ? i : edges_.size();
  }

 private:
  std::span<const BoundaryEdge> edges_;
  ZeroedArray<Index>& slots_;
};

// The edge that follows each one, or nothing unless every vertex has one edge in and one edge out.
std::vector<Index> simple_successors(std::span<const BoundaryEdge> edges, EdgesByStart& by_start) {
  const std::size_t n = edges.size();
  for (std::size_t i = 1; i < n; ++i) {
    if (edges[i].from == edges[i - 1].from) return {};
  }
  std::vector<Index> next(n);
  std::vector<bool> entered(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = by_start.find(edges[i].to);
    if (j == n || entered[j]) return {};
    entered[j] = true;
    next[i] = static_cast<Index>(j);
  }
  return next;
}

std::vector<BoundaryLoop> follow(std::span<const BoundaryEdge> edges, std::vector<Index> next,
                                 ArrayBlocks<Index>& arrays) {
  constexpr Index kDone = std::numeric_limits<Index>::max();
  std::vector<BoundaryLoop> loops;
  std::vector<Index> path;
  for (std::size_t start = 0; start < edges.size(); ++start) {
    if (next[start] == kDone) continue;
    path.clear();
    for (std::size_t i = start; next[i] != kDone;) {
      path.push_back(edges[i].from);
      i = std::exchange(next[i], kDone);
    }
    loops.push_back({arrays.make(path), true});
  }
  return loops;
}

}  // namespace

LoopTrace trace_loops(std::span<const Triangle> triangles, std::span<const BoundaryEdge> edges,
                      std::size_t vertex_bound, Workspace& workspace) {
  if (edges.empty()) return {};
  EdgesByStart by_start(edges, vertex_bound, workspace.slots);
  std::vector<Index> next = simple_successors(edges, by_start);
  if (!next.empty()) return {follow(edges, std::move(next), workspace.vertex_arrays), edges.size(), 0};
  return trace_paired(triangles, edges, vertex_bound, workspace);
}

}  // namespace meshcontour::detail
