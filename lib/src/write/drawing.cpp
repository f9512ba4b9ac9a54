#include "write/drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <unordered_set>

#include "meshcontour/fit.hpp"
#include "write/sampling.hpp"

namespace meshcontour::detail {
namespace {

std::string patch_name(const Shell& shell, std::size_t patch) {
  return fmt::format("shell_{}_patch_{}", shell.id, patch + 1);
}

// Cuts a ring or chain of parts at those that are left out; begins a closed one after a gap.
// Returns ranges [first, last) of part numbers, to be taken modulo the number of parts.
std::vector<std::pair<std::size_t, std::size_t>> runs_of(const std::vector<bool>& left_out, bool closed) {
  const std::size_t count = left_out.size();
  const auto gap = std::ranges::find(left_out, true);
  if (gap == left_out.end()) return {{0, count}};
  std::size_t first = closed ? static_cast<std::size_t>(gap - left_out.begin()) + 1 : 0;
  const std::size_t end = closed ? first + count - 1 : count;
  std::vector<std::pair<std::size_t, std::size_t>> runs;
  while (first < end) {
    if (left_out[first % count]) {
      ++first;
      continue;
    }
    std::size_t last = first;
    while (last < end && !left_out[last % count]) ++last;
    runs.emplace_back(first, last);
    first = last;
  }
  return runs;
}

// Decides which parts of loops are written. Where a shell is placed again the decisions are the same, so they
// are made once: fitted segments by the edges they run along, chords by their two vertices.
class Repeats {
 public:
  Repeats(const Result& result, EdgeUse edges)
      : contours_(result.contours), unique_(edges == EdgeUse::Unique) {
    if (unique_) segments_ = repeated_segments(contours_);
  }

  void begin_shell() { chords_.clear(); }

  std::vector<bool> of(const Contour& contour) const {
    if (!unique_) return std::vector<bool>(contour.segments.size(), false);
    return segments_[static_cast<std::size_t>(&contour - contours_.data())];
  }

  std::vector<bool> of(const BoundaryLoop& loop) {
    const std::size_t count = loop.vertices.size(),
                      chords = loop.closed ? count : count - std::min<std::size_t>(count, 1);
    std::vector<bool> repeated(chords, false);
    for (std::size_t i = 0; unique_ && i < chords; ++i) {
      const auto [low, high] = std::minmax(loop.vertices[i], loop.vertices[(i + 1) % count]);
      repeated[i] = !chords_.insert(std::uint64_t{low} << 32 | high).second;
    }
    return repeated;
  }

 private:
  std::span<const Contour> contours_;
  bool unique_;
  std::vector<std::vector<bool>> segments_;
  std::unordered_set<std::uint64_t> chords_;  // only asked, never listed
};

struct Place {
  const Shell& shell;
  const Eigen::Affine3d& placement;
  bool identity;
};

Chain empty_chain(const std::string& name, const std::vector<std::pair<std::size_t, std::size_t>>& runs,
                  std::size_t run, bool closed) {
  Chain chain;
  chain.name = runs.size() == 1 ? name : fmt::format("{}_part_{}", name, run + 1);
  chain.closed = closed;
  return chain;
}

void add_polygon(const Place& place, const BoundaryLoop& loop, const std::string& name, Repeats& repeats,
                 std::vector<Chain>& chains) {
  const std::vector<bool> repeated = repeats.of(loop);
  const auto runs = runs_of(repeated, loop.closed);
  const std::size_t count = loop.vertices.size();
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const auto [first, last] = runs[r];
    Chain chain = empty_chain(name, runs, r, loop.closed && last - first == repeated.size());
    for (std::size_t i = first; i < last + (chain.closed ? 0 : 1); ++i) {
      chain.points.push_back(place.placement * place.shell.points[loop.vertices[i % count]]);
    }
    chains.push_back(std::move(chain));
  }
}

void add_contour(const Place& place, const Contour& contour, const std::string& name, const Repeats& repeats,
                 std::vector<Chain>& chains) {
  const std::vector<bool> repeated = repeats.of(contour);
  const auto runs = runs_of(repeated, contour.closed);
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const auto [first, last] = runs[r];
    Chain chain = empty_chain(name, runs, r, contour.closed && last - first == repeated.size());
    for (std::size_t i = first; i < last; ++i) {
      const Curve& curve = contour.segments[i % repeated.size()].curve;
      chain.curves.push_back(place.identity ? curve : transformed(curve, place.placement));
    }
    chains.push_back(std::move(chain));
  }
}

// A contour that is the loop's own polygon is written as one polyline, not as its many lines.
bool is_polygon(const Contour* contour, LoopShape shape) {
  return contour == nullptr || contour->fallback || contour->segments.empty() || shape == LoopShape::Polygon;
}

Group patch_group(const Result& result, const Instance& instance, std::size_t patch,
                  const std::string& suffix, LoopShape shape, Repeats& repeats) {
  const Shell& shell = result.model.shells[instance.shell];
  const bool identity = instance.placement.matrix() == Eigen::Matrix4d::Identity();
  const Place place{shell, instance.placement, identity};
  const auto& loops = result.boundaries[instance.shell].patches[patch].loops;
  Group group;
  group.patch = patch;
  group.layer = patch_name(shell, patch);
  group.name = group.layer + suffix;
  for (std::size_t l = 0; l < loops.size(); ++l) {
    const Contour* contour = find_contour(result.contours, instance.shell, patch, l);
    const std::string name = fmt::format("{}_loop_{}{}", group.layer, l + 1, suffix);
    if (is_polygon(contour, shape)) {
      add_polygon(place, loops[l], name, repeats, group.chains);
    } else {
      add_contour(place, *contour, name, repeats, group.chains);
    }
  }
  return group;
}

std::string annotation_name(const Polyline& line, std::size_t number) {
  return line.name.empty() ? fmt::format("annotation_{}", number + 1)
                           : fmt::format("annotation_{}", line.name);
}

std::string curve_name(const NamedCurve& curve, std::size_t number) {
  return curve.name.empty() ? fmt::format("curve_{}", number + 1) : fmt::format("curve_{}", curve.name);
}

}  // namespace

void for_each_patch_group(const Result& result, std::span<const Instance> instances, EdgeUse edges,
                          LoopShape shape, const std::function<void(std::size_t, const Group&)>& visit) {
  const std::size_t shells = result.model.shells.size();
  std::vector<std::size_t> occurrences(shells, 0), occurrence(shells, 0);
  for (const Instance& instance : instances) ++occurrences[instance.shell];
  Repeats repeats(result, edges);
  for (std::size_t i = 0; i < instances.size(); ++i) {
    const Instance& instance = instances[i];
    const std::size_t number = ++occurrence[instance.shell];
    const std::string suffix =
        occurrences[instance.shell] > 1 ? fmt::format("_instance_{}", number) : std::string();
    const std::size_t patches =
        result.boundaries.empty() ? 0 : result.boundaries[instance.shell].patches.size();
    repeats.begin_shell();
    for (std::size_t p = 0; p < patches; ++p) {
      const Group group = patch_group(result, instance, p, suffix, shape, repeats);
      if (!group.chains.empty()) visit(i, group);
    }
  }
}

void for_each_group(const Result& result, EdgeUse edges, LoopShape shape,
                    const std::function<void(const Group&)>& visit) {
  const Model& model = result.model;
  for_each_patch_group(result, model.instances, edges, shape,
                       [&](std::size_t, const Group& group) { visit(group); });
  for (std::size_t i = 0; i < model.annotations.size(); ++i) {
    const Polyline& line = model.annotations[i];
    if (line.points.size() < 2) continue;
    const std::string name = annotation_name(line, i);
    visit({name, name, {{name, false, {}, line.points}}, 0});
  }
  for (std::size_t i = 0; i < model.curves.size(); ++i) {
    const std::string name = curve_name(model.curves[i], i);
    const Curve& curve = model.curves[i].curve;
    const bool closed = start_of(curve) == end_of(curve);
    visit({name, name, {{name, closed, {curve}, {}}}, 0});
  }
}

std::vector<std::string> layers(const Result& result) {
  std::vector<std::string> names;
  std::vector<bool> placed(result.model.shells.size(), false);
  for (const Instance& instance : result.model.instances) {
    if (placed[instance.shell] || result.boundaries.empty()) continue;
    placed[instance.shell] = true;
    const auto& patches = result.boundaries[instance.shell].patches;
    for (std::size_t p = 0; p < patches.size(); ++p) {
      if (!patches[p].loops.empty()) names.push_back(patch_name(result.model.shells[instance.shell], p));
    }
  }
  for (std::size_t i = 0; i < result.model.annotations.size(); ++i) {
    names.push_back(annotation_name(result.model.annotations[i], i));
  }
  for (std::size_t i = 0; i < result.model.curves.size(); ++i) {
    names.push_back(curve_name(result.model.curves[i], i));
  }
  std::unordered_set<std::string_view> known;
  std::vector<std::string> unique;
  for (const std::string& name : names) {
    if (known.insert(name).second) unique.push_back(name);
  }
  return unique;
}

const Contour* find_contour(std::span<const Contour> contours, std::size_t shell, std::size_t patch,
                            std::size_t loop) {
  const auto key = [](const Contour& c) { return std::tuple(c.shell, c.patch, c.loop); };
  const auto found = std::ranges::lower_bound(contours, std::tuple(shell, patch, loop), {}, key);
  return found != contours.end() && key(*found) == std::tuple(shell, patch, loop) ? &*found : nullptr;
}

}  // namespace meshcontour::detail
