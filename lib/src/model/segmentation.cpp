#include "meshcontour/segmentation.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/large_array.hpp"
#include "model/adjacency.hpp"
#include "model/sharp_sides.hpp"

namespace meshcontour {
namespace {

using detail::Adjacency;

constexpr Index kUnlabelled = detail::kNoSide;

// Numbers the pieces that `crosses(side)` leaves connected, from 0 by their first triangle.
template <typename Crosses>
std::vector<Index> flood(const Adjacency& adjacency, Crosses&& crosses) {
  std::vector<Index> labels;
  detail::assign_large(labels, adjacency.opposite.size() / 3, kUnlabelled);
  std::vector<Index> front;
  Index next_label = 0;
  for (Index seed = 0; seed < labels.size(); ++seed) {
    if (labels[seed] != kUnlabelled) continue;
    labels[seed] = next_label;
    for (front.assign(1, seed); !front.empty();) {
      const Index triangle = front.back();
      front.pop_back();
      for (Index side = 3 * triangle; side < 3 * triangle + 3; ++side) {
        if (!crosses(side)) continue;
        const Index neighbour = detail::triangle_of(adjacency.opposite[side]);
        if (labels[neighbour] != kUnlabelled) continue;
        labels[neighbour] = next_label;
        front.push_back(neighbour);
      }
    }
    ++next_label;
  }
  return labels;
}

// Sharp edges whose two triangles have the same label, as sorted pairs of points.
std::vector<std::array<Index, 2>> inner_sharp_edges(const Shell& shell, const Adjacency& adjacency,
                                                    const std::vector<std::uint8_t>& smooth,
                                                    const std::vector<Index>& labels) {
  std::vector<std::array<Index, 2>> edges;
  for (Index side = 0; side < smooth.size(); ++side) {
    const Index other = adjacency.opposite[side];
    if (smooth[side] || !detail::is_paired(other) || other < side) continue;
    if (labels[detail::triangle_of(side)] != labels[detail::triangle_of(other)]) continue;
    const Index from = detail::side_start(shell.triangles, side),
                to = detail::side_end(shell.triangles, side);
    edges.push_back({std::min(from, to), std::max(from, to)});
  }
  std::ranges::sort(edges);
  return edges;
}

template <typename Item>
void reorder(std::vector<Item>& items, std::size_t per_triangle, const std::vector<Index>& new_place) {
  std::vector<Item> sorted;
  detail::reserve_large(sorted, items.size());
  sorted.resize(items.size());
  for (std::size_t t = 0; t < new_place.size(); ++t) {
    for (std::size_t k = 0; k < per_triangle; ++k) {
      sorted[new_place[t] * per_triangle + k] = items[t * per_triangle + k];
    }
  }
  items = std::move(sorted);
}

// Joins labels of triangles that meet at an edge of three or more.
class LabelSets {
 public:
  explicit LabelSets(std::size_t count) : parent_(count) {
    for (std::size_t i = 0; i < count; ++i) parent_[i] = static_cast<Index>(i);
  }
  Index find(Index label) {
    while (parent_[label] != label) label = parent_[label] = parent_[parent_[label]];
    return label;
  }
  void join(Index a, Index b) {
    a = find(a), b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<Index> parent_;
};

// Labels joined wherever an edge of three or more triangles connects them.
void join_across_nonmanifold_edges(const Shell& shell, const Adjacency& adjacency,
                                   std::vector<Index>& labels) {
  struct End {
    std::array<Index, 2> edge;
    Index label;
  };
  std::vector<End> ends;
  for (Index side = 0; side < adjacency.opposite.size(); ++side) {
    if (adjacency.opposite[side] != detail::kManySides) continue;
    const Index from = detail::side_start(shell.triangles, side),
                to = detail::side_end(shell.triangles, side);
    ends.push_back({{std::min(from, to), std::max(from, to)}, labels[detail::triangle_of(side)]});
  }
  std::ranges::stable_sort(ends, {}, &End::edge);
  LabelSets sets(labels.size());
  for (std::size_t i = 1; i < ends.size(); ++i) {
    if (ends[i].edge == ends[i - 1].edge) sets.join(ends[i].label, ends[i - 1].label);
  }
  for (Index& label : labels) label = sets.find(label);
}

void add_crease_note(const Model& model, std::vector<Diagnostic>& diagnostics) {
  std::size_t creases = 0;
  for (const Shell& shell : model.shells) creases += shell.creases.size();
  if (creases == 0) return;
  diagnostics.push_back(
      {Diagnostic::Severity::Note, "sharp edge inside a patch, drawn but no boundary", {}, creases});
}

void segment_by(PatchSource source, Shell& shell, const SegmentOptions& options) {
  if (source == PatchSource::Angle) {
    segment_by_feature_angle(shell, options.feature_angle, options.threads);
  } else if (source == PatchSource::Components) {
    segment_by_components(shell, options.threads);
  } else {
    merge_patches(shell);
  }
}

}  // namespace

std::vector<Index> group_triangles(Shell& shell, const std::vector<Index>& numbers) {
  const std::size_t bound = numbers.empty() ? 0 : std::size_t{*std::ranges::max_element(numbers)} + 1;
  std::vector<Index> patch_of(bound, kUnlabelled), number_of;
  std::vector<Patch> patches;
  for (const Index number : numbers) {
    if (patch_of[number] == kUnlabelled) {
      patch_of[number] = static_cast<Index>(patches.size());
      patches.push_back({"", shell.color, 0, 0});
      number_of.push_back(number);
    }
    ++patches[patch_of[number]].triangle_count;
  }
  for (std::size_t p = 1; p < patches.size(); ++p) {
    patches[p].first_triangle = patches[p - 1].first_triangle + patches[p - 1].triangle_count;
  }
  if (!std::ranges::is_sorted(numbers, {}, [&](Index number) { return patch_of[number]; })) {
    std::vector<std::size_t> next(patches.size());
    for (std::size_t p = 0; p < patches.size(); ++p) next[p] = patches[p].first_triangle;
    std::vector<Index> new_place;
    detail::assign_large<Index>(new_place, numbers.size(), 0);
    for (std::size_t t = 0; t < numbers.size(); ++t)
      new_place[t] = static_cast<Index>(next[patch_of[numbers[t]]]++);
    reorder(shell.triangles, 1, new_place);
    if (!shell.corner_normals.empty()) reorder(shell.corner_normals, 3, new_place);
  }
  shell.patches = std::move(patches);
  return number_of;
}

std::size_t segment_by_feature_angle(Shell& shell, double radians, unsigned threads) {
  if (!(radians > 0) || !(radians < std::numbers::pi)) {
    throw Error(ErrorCode::Usage, fmt::format("feature angle {} is not between 0 and 180 degrees",
                                              radians * 180 / std::numbers::pi));
  }
  const Adjacency adjacency = detail::side_adjacency(shell.triangles, shell.points.size(), threads);
  const std::vector<std::uint8_t> smooth = detail::smooth_sides(shell, adjacency, radians, threads);
  const std::vector<Index> labels = flood(adjacency, [&](Index side) { return smooth[side] != 0; });
  shell.creases = inner_sharp_edges(shell, adjacency, smooth, labels);
  group_triangles(shell, labels);
  return shell.patches.size();
}

std::size_t segment_by_components(Shell& shell, unsigned threads) {
  const Adjacency adjacency = detail::side_adjacency(shell.triangles, shell.points.size(), threads);
  std::vector<Index> labels =
      flood(adjacency, [&](Index side) { return detail::is_paired(adjacency.opposite[side]); });
  if (adjacency.nonmanifold_edges > 0) join_across_nonmanifold_edges(shell, adjacency, labels);
  shell.creases.clear();
  group_triangles(shell, labels);
  return shell.patches.size();
}

void merge_patches(Shell& shell) {
  shell.creases.clear();
  shell.patches.assign(1, {"", shell.color, 0, shell.triangles.size()});
}

void segment_model(Model& model, const SegmentOptions& options) {
  PatchSource source = options.source;
  if (source == PatchSource::Automatic) source = model.has_patches ? PatchSource::File : PatchSource::Angle;
  if (source == PatchSource::File) return;
  for (Shell& shell : model.shells) segment_by(source, shell, options);
  model.has_patches = true;
  add_crease_note(model, model.diagnostics);
}

}  // namespace meshcontour
