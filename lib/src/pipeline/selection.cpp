#include "pipeline/selection.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace meshcontour::detail {
namespace {

bool holds(const PatchSelection& selection, std::size_t patch) {
  const auto in_range = [&](const auto& range) {
    return range.first <= patch + 1 && patch + 1 <= range.second;
  };
  return selection.patches.empty() || std::ranges::any_of(selection.patches, in_range);
}

// Creases stay where triangles stay.
void keep_creases(Shell& shell) {
  std::vector<bool> used(shell.creases.size(), false);
  for (const Triangle& t : shell.triangles) {
    for (const auto& [a, b] : {std::minmax(t[0], t[1]), std::minmax(t[1], t[2]), std::minmax(t[2], t[0])}) {
      const std::array<Index, 2> side{a, b};
      const auto found = std::ranges::lower_bound(shell.creases, side);
      if (found != shell.creases.end() && *found == side) {
        used[static_cast<std::size_t>(found - shell.creases.begin())] = true;
      }
    }
  }
  std::size_t next = 0;
  std::erase_if(shell.creases, [&](const auto&) { return !used[next++]; });
}

// Returns the number of patches that stay.
std::size_t keep_patches(Shell& shell, const PatchSelection& selection) {
  const bool shell_chosen = selection.shell.empty() || selection.shell == shell.id;
  std::size_t kept = 0, next = 0;
  for (std::size_t p = 0; p < shell.patches.size(); ++p) {
    Patch& patch = shell.patches[p];
    const std::size_t first = patch.first_triangle;
    patch.first_triangle = next;
    if (!shell_chosen || !holds(selection, p)) {
      patch.triangle_count = 0;
      continue;
    }
    ++kept;
    const auto move_down = [&](auto& list, std::size_t each) {
      const auto from = list.begin() + static_cast<std::ptrdiff_t>(each * first);
      std::copy_n(from, each * patch.triangle_count, list.begin() + static_cast<std::ptrdiff_t>(each * next));
    };
    move_down(shell.triangles, 1);
    if (!shell.corner_normals.empty()) move_down(shell.corner_normals, 3);
    next += patch.triangle_count;
  }
  shell.triangles.resize(next);
  if (!shell.corner_normals.empty()) shell.corner_normals.resize(3 * next);
  if (!shell.creases.empty()) keep_creases(shell);
  return kept;
}

}  // namespace

void keep_selection(Model& model, const PatchSelection& selection) {
  if (selection.everything()) return;
  std::size_t kept = 0, most = 0;
  for (Shell& shell : model.shells) {
    most = std::max(most, shell.patches.size());
    kept += keep_patches(shell, selection);
  }
  if (kept > 0) return;
  const auto is_chosen = [&](const Shell& shell) { return shell.id == selection.shell; };
  if (!selection.shell.empty() && std::ranges::none_of(model.shells, is_chosen)) {
    throw Error(ErrorCode::Usage,
                fmt::format("--shell: the model has no shell '{}'", printable(selection.shell)));
  }
  throw Error(ErrorCode::Usage,
              fmt::format("--patches: none of these patches exists; the largest number is {}", most));
}

}  // namespace meshcontour::detail
