#include "multires/wavelet_reduction.hpp"

#include <algorithm>

#include "multires/patches.hpp"

namespace meshcontour::detail {
namespace {

constexpr Index kNone = MeshLevel::kNone;

std::vector<Point> reordered(const std::vector<Point>& points, const std::vector<Index>& order) {
  std::vector<Point> out(order.size());
  for (std::size_t v = 0; v < order.size(); ++v) out[v] = points[order[v]];
  return out;
}

// Vertices that must stay, in the order of the subdivision.
std::vector<bool> kept_vertices(const Shell& shell, const std::vector<Index>& order) {
  std::vector<bool> marked(shell.points.size(), false), kept(order.size());
  mark_loop_starts(shell, marked);
  for (std::size_t v = 0; v < order.size(); ++v) kept[v] = marked[order[v]];
  return kept;
}

}  // namespace

WaveletReduction::WaveletReduction(const Shell& shell, const SubdivisionConnectivity& connectivity)
    : base_(connectivity.base),
      order_(connectivity.order),
      mesh_(connectivity, reordered(shell.points, order_), kept_vertices(shell, order_)) {}

Shell WaveletReduction::within(double error) const {
  const AdaptiveMesh::ActiveEdges active = mesh_.edges_above(error);
  std::vector<std::size_t> first;
  const std::vector<Triangle> triangles = mesh_.triangles(active, first);
  return shell_of(mesh_.fitted(active), triangles, first);
}

// Vertices keep the order that they had in the shell.
Shell WaveletReduction::shell_of(const std::vector<Point>& points, const std::vector<Triangle>& triangles,
                                 const std::vector<std::size_t>& first) const {
  Shell shell;
  shell.id = base_.id;
  shell.color = base_.color;
  shell.patches = base_.patches;
  for (Patch& patch : shell.patches) {
    const std::size_t end = first[patch.first_triangle + patch.triangle_count];
    patch.first_triangle = first[patch.first_triangle];
    patch.triangle_count = end - patch.first_triangle;
  }
  std::vector<Index> number(order_.size(), kNone);
  for (const Triangle& t : triangles) {
    for (const Index v : t) number[v] = 0;
  }
  Index largest = 0;
  for (const Index v : order_) largest = std::max(largest, v);
  std::vector<Index> vertices(std::size_t{largest} + 1, kNone);
  for (Index v = 0; v < order_.size(); ++v) {
    if (number[v] != kNone) vertices[order_[v]] = v;
  }
  for (const Index v : vertices) {
    if (v == kNone) continue;
    number[v] = static_cast<Index>(shell.points.size());
    shell.points.push_back(points[v]);
  }
  for (const Triangle& t : triangles) shell.triangles.push_back({number[t[0]], number[t[1]], number[t[2]]});
  return shell;
}

}  // namespace meshcontour::detail
