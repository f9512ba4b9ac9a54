#include "multires/wavelet_reduction.hpp"

#include <algorithm>
#include <limits>

#include "multires/edge_collapse.hpp"
#include "multires/patches.hpp"
#include "multires/surface_fit.hpp"

namespace meshcontour::detail {
namespace {

constexpr Index kNone = MeshLevel::kNone;
constexpr double kSurplus = 1.6;  // triangles that are chosen for one that stays
constexpr int kFirstRounds = 1, kLastRounds = 2;

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

WaveletReduction::WaveletReduction(const Shell& shell, const Shell& surface,
                                   const SubdivisionConnectivity& connectivity, EdgeMeasure measure,
                                   unsigned threads)
    : shell_(shell),
      surface_(surface),
      base_(connectivity.base),
      order_(connectivity.order),
      mesh_(connectivity, reordered(shell.points, order_), kept_vertices(shell, order_), measure),
      threads_(threads) {}

Shell WaveletReduction::within(double error) const {
  Shell shell = chosen(error);
  fit_to_surface(shell, surface_, kLastRounds, threads_);
  return shell;
}

Shell WaveletReduction::with(std::size_t triangles) const {
  const auto more = static_cast<std::size_t>(kSurplus * static_cast<double>(triangles));
  Shell shell = chosen(mesh_.error_for(more));
  fit_to_surface(shell, surface_, kFirstRounds, threads_);
  shell = collapsed(shell, triangles, std::numeric_limits<double>::infinity(), threads_, true);
  fit_to_surface(shell, surface_, kLastRounds, threads_);
  return shell;
}

// The mesh of the details with at least so large an error, with vertices of the shell in its order.
Shell WaveletReduction::chosen(double error) const {
  const std::vector<Point>& points = shell_.points;
  std::vector<std::size_t> first;
  const std::vector<Triangle> triangles = mesh_.triangles(mesh_.edges_above(error), first);
  Shell shell;
  shell.id = base_.id;
  shell.color = base_.color;
  shell.patches = base_.patches;
  for (Patch& patch : shell.patches) {
    const std::size_t end = first[patch.first_triangle + patch.triangle_count];
    patch.first_triangle = first[patch.first_triangle];
    patch.triangle_count = end - patch.first_triangle;
  }
  std::vector<Index> number(points.size(), kNone);
  for (const Triangle& t : triangles) {
    for (const Index v : t) number[order_[v]] = 0;
  }
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] == kNone) continue;
    number[v] = static_cast<Index>(shell.points.size());
    shell.points.push_back(points[v]);
  }
  for (const auto& [a, b, c] : triangles) {
    shell.triangles.push_back({number[order_[a]], number[order_[b]], number[order_[c]]});
  }
  return shell;
}

}  // namespace meshcontour::detail
