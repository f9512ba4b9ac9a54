#include "meshcontour/cleaning.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "model/adjacency.hpp"
#include "model/fans.hpp"
#include "model/orientation.hpp"
#include "model/point_attributes.hpp"

namespace meshcontour {
namespace {

using detail::Adjacency;

// Removes the triangles for which drop(t) holds; corner normals and patches follow.
template <typename Drop>
std::size_t drop_triangles(Shell& shell, Drop&& drop) {
  std::size_t kept = 0, t = 0;
  const auto keep = [&] {
    shell.triangles[kept] = shell.triangles[t];
    for (std::size_t k = 0; k < 3 && !shell.corner_normals.empty(); ++k) {
      shell.corner_normals[3 * kept + k] = shell.corner_normals[3 * t + k];
    }
    ++kept;
  };
  for (Patch& patch : shell.patches) {
    const std::size_t first = kept;
    for (const std::size_t end = t + patch.triangle_count; t < end; ++t) {
      if (!drop(t)) keep();
    }
    patch.first_triangle = first;
    patch.triangle_count = kept - first;
  }
  const std::size_t dropped = shell.triangles.size() - kept;
  shell.triangles.resize(kept);
  if (!shell.corner_normals.empty()) shell.corner_normals.resize(3 * kept);
  return dropped;
}

bool is_degenerate(const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

// A triangle has a copy only if on each of its edges there are three or more triangles, or just the two of
// them.
bool may_have_copy(const Adjacency& adjacency, Index triangle) {
  Index other = detail::kNoSide;
  for (Index side = 3 * triangle; side < 3 * triangle + 3; ++side) {
    const Index opposite = adjacency.opposite[side];
    if (opposite == detail::kNoSide) return false;
    if (opposite == detail::kManySides) continue;
    if (other != detail::kNoSide && other != detail::triangle_of(opposite)) return false;
    other = detail::triangle_of(opposite);
  }
  return true;
}

struct Candidate {
  Triangle points;  // sorted
  Index triangle;
};

// Triangles with the points of an earlier one, sorted.
std::vector<Index> find_copies(const Shell& shell, const Adjacency& adjacency) {
  std::vector<Candidate> candidates;
  for (Index t = 0; t < shell.triangles.size(); ++t) {
    if (!may_have_copy(adjacency, t)) continue;
    Triangle points = shell.triangles[t];
    std::ranges::sort(points);
    candidates.push_back({points, t});
  }
  std::ranges::stable_sort(candidates, {}, &Candidate::points);
  std::vector<Index> copies;
  for (std::size_t i = 1; i < candidates.size(); ++i) {
    if (candidates[i].points == candidates[i - 1].points) copies.push_back(candidates[i].triangle);
  }
  std::ranges::sort(copies);
  return copies;
}

std::size_t drop_copies(Shell& shell, const Adjacency& adjacency) {
  const std::vector<Index> copies = find_copies(shell, adjacency);
  if (copies.empty()) return 0;
  auto next = copies.begin();
  return drop_triangles(shell,
                        [&](std::size_t t) { return next != copies.end() && *next == t && (++next, true); });
}

std::vector<std::uint8_t> used_points(const Shell& shell) {
  std::vector<std::uint8_t> used(shell.points.size(), 0);
  for (const Triangle& t : shell.triangles) used[t[0]] = used[t[1]] = used[t[2]] = 1;
  return used;
}

void report(const CleaningCounts& counts, const Spot& spot, std::vector<Diagnostic>& diagnostics) {
  const auto warn = [&](std::size_t count, const char* message) {
    if (count > 0) diagnostics.push_back({Diagnostic::Severity::Warning, message, spot, count});
  };
  warn(counts.unused_points, "point that no triangle uses, left out");
  warn(counts.degenerate_triangles, "triangle that names a point twice, removed");
  warn(counts.duplicate_triangles, "triangle with the points of an earlier one, removed");
  warn(counts.turned_triangles, "triangle that runs against its neighbours, turned round");
  warn(counts.unorientable_components, "component that cannot be oriented (as a Moebius strip), kept");
  warn(counts.nonmanifold_edges, "edge with three or more triangles, kept");
  warn(counts.bow_tie_vertices, "point where fans of triangles only touch (bow tie), kept");
}

}  // namespace

bool has_area(const Shell& shell) {
  constexpr double kThinnest = 1e-12;
  return std::ranges::any_of(shell.triangles, [&](const Triangle& t) {
    const Vector a = shell.points[t[1]] - shell.points[t[0]], b = shell.points[t[2]] - shell.points[t[0]];
    const double longest = std::max({a.stableNorm(), b.stableNorm(), (b - a).stableNorm()});
    return longest > 0 && (a / longest).cross(b / longest).norm() > kThinnest;
  });
}

std::size_t count_unused_points(const Shell& shell) {
  return static_cast<std::size_t>(std::ranges::count(used_points(shell), 0));
}

std::size_t drop_degenerate_triangles(Shell& shell) {
  if (std::ranges::none_of(shell.triangles, is_degenerate)) return 0;
  return drop_triangles(shell, [&](std::size_t t) { return is_degenerate(shell.triangles[t]); });
}

std::size_t drop_unused_points(Shell& shell) {
  const std::vector<std::uint8_t> used = used_points(shell);
  std::vector<Index> number(used.size());
  Index kept = 0;
  for (std::size_t v = 0; v < used.size(); ++v) {
    number[v] = kept;
    if (used[v] == 0) continue;
    shell.points[kept] = Point(shell.points[v]);
    detail::copy_point_attributes(shell, v, kept++);
  }
  shell.points.resize(kept);
  detail::resize_point_attributes(shell);
  for (Triangle& t : shell.triangles) t = {number[t[0]], number[t[1]], number[t[2]]};
  return used.size() - kept;
}

CleaningCounts clean_shell(Shell& shell, const Spot& spot, std::vector<Diagnostic>& diagnostics,
                           unsigned threads) {
  CleaningCounts counts;
  counts.unused_points = count_unused_points(shell);
  counts.degenerate_triangles = drop_degenerate_triangles(shell);
  Adjacency adjacency = detail::side_adjacency(shell.triangles, shell.points.size(), threads);
  counts.duplicate_triangles = drop_copies(shell, adjacency);
  if (counts.duplicate_triangles > 0) {
    adjacency = detail::side_adjacency(shell.triangles, shell.points.size(), threads);
  }
  const auto orientation = detail::orient_components(shell, adjacency, detail::Unorientable::Keep);
  counts.turned_triangles = orientation.turned;
  counts.unorientable_components = orientation.unorientable;
  counts.nonmanifold_edges = adjacency.nonmanifold_edges;
  counts.bow_tie_vertices = detail::count_bow_ties(shell, adjacency, threads);
  report(counts, spot, diagnostics);
  return counts;
}

RepairCounts repair_shell(Shell& shell, unsigned threads) {
  RepairCounts counts;
  shell.creases.clear();
  drop_degenerate_triangles(shell);
  Adjacency adjacency = detail::side_adjacency(shell.triangles, shell.points.size(), threads);
  counts.turned_triangles = detail::orient_components(shell, adjacency, detail::Unorientable::Turn).turned;
  counts.added_points = detail::split_fans(shell, adjacency);
  counts.removed_points = drop_unused_points(shell);
  return counts;
}

void repair_model(Model& model, unsigned threads) {
  RepairCounts sum;
  for (Shell& shell : model.shells) {
    const RepairCounts counts = repair_shell(shell, threads);
    sum.removed_points += counts.removed_points;
    sum.added_points += counts.added_points;
    sum.turned_triangles += counts.turned_triangles;
  }
  if (sum.removed_points + sum.added_points + sum.turned_triangles == 0) return;
  model.diagnostics.push_back({Diagnostic::Severity::Note,
                               fmt::format("repaired: {} points removed, {} added, {} triangles turned",
                                           sum.removed_points, sum.added_points, sum.turned_triangles),
                               {},
                               1});
}

}  // namespace meshcontour
