#include "boundary/local_patch.hpp"

#include <algorithm>

#include "boundary/edge_filter.hpp"
#include "model/adjacency.hpp"
#include "model/fans.hpp"
#include "model/orientation.hpp"

namespace meshcontour::detail {
namespace {

// The patch as a shell, without triangles that repeat an index.
Shell sound_shell(const Shell& shell, const LocalPatch& patch) {
  Shell sound;
  sound.points.reserve(patch.vertices.size());
  for (const Index v : patch.vertices) sound.points.push_back(shell.points[v]);
  std::ranges::remove_copy_if(patch.triangles, std::back_inserter(sound.triangles), degenerate);
  return sound;
}

}  // namespace

LocalPatch number_locally(std::span<const Triangle> triangles, std::size_t vertex_bound,
                          ZeroedArray<Index>& slots) {
  slots.reserve(vertex_bound);
  LocalPatch patch{{triangles.begin(), triangles.end()}, {}};
  for (Triangle& triangle : patch.triangles) {
    for (Index& v : triangle) {
      Index& slot = slots[v];  // a hint, right or stale
      if (slot >= patch.vertices.size() || patch.vertices[slot] != v) {
        slot = static_cast<Index>(patch.vertices.size());
        patch.vertices.push_back(v);
      }
      v = slot;
    }
  }
  return patch;
}

std::vector<bool> turned_triangles(const Shell& shell, const LocalPatch& patch) {
  Shell sound = sound_shell(shell, patch);
  Adjacency adjacency = side_adjacency(sound.triangles, sound.points.size(), 1);
  orient_components(sound, adjacency, Unorientable::Turn);
  std::vector<bool> turned(patch.triangles.size());
  for (std::size_t i = 0, next = 0; i < turned.size(); ++i) {
    if (!degenerate(patch.triangles[i])) turned[i] = sound.triangles[next++] != patch.triangles[i];
  }
  return turned;
}

bool is_orientable_manifold(const Shell& shell, const LocalPatch& patch) {
  Shell sound = sound_shell(shell, patch);
  Adjacency adjacency = side_adjacency(sound.triangles, sound.points.size(), 1);
  return adjacency.nonmanifold_edges == 0 && count_bow_ties(sound, adjacency, 1) == 0 &&
         orient_components(sound, adjacency, Unorientable::Keep).unorientable == 0;
}

}  // namespace meshcontour::detail
