#pragma once

// What the geometry formats write, in the model's frame: groups of chains.

#include <functional>
#include <string>
#include <vector>

#include "meshcontour/write.hpp"

namespace meshcontour::detail {

/// Curves or points joined end to start: a loop, or what is left of one when shared edges are written once.
struct Chain {
  std::string name;
  bool closed = false;
  std::vector<Curve> curves;
  std::vector<Point> points;  ///< instead of curves; when closed the first is not repeated
};

/// The chains of one patch in one place, one annotation, or one curve of the model.
struct Group {
  std::string name;   ///< of this occurrence
  std::string layer;  ///< the same for all occurrences of the patch
  std::vector<Chain> chains;
  std::size_t patch = 0;  ///< of a patch's chains: its index in the shell
};

/// What becomes of a loop that has a contour.
enum class LoopShape { Fitted, Polygon };

/// Calls `visit` for each group that is not empty, in order of instance and patch, then annotations, then
/// curves. One group at a time is in memory.
void for_each_group(const Result& result, EdgeUse edges, LoopShape shape,
                    const std::function<void(const Group&)>& visit);

/// The groups of the patches of the given instances, which need not be the model's; `visit` also gets the
/// number of the instance, from 0.
void for_each_patch_group(const Result& result, std::span<const Instance> instances, EdgeUse edges,
                          LoopShape shape, const std::function<void(std::size_t, const Group&)>& visit);

/// The layers of all groups, each once, in order of first use.
std::vector<std::string> layers(const Result& result);

/// The contour of a loop; null if it has none. Binary search.
const Contour* find_contour(std::span<const Contour> contours, std::size_t shell, std::size_t patch,
                            std::size_t loop);

}  // namespace meshcontour::detail
