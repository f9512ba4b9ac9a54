#pragma once

#include <span>

#include "boundary/workspace.hpp"
#include "meshcontour/boundary.hpp"

namespace meshcontour::detail {

inline constexpr std::size_t kSmallPatchTriangles = 128;

/// The boundary of a patch of at most 64 vertices whose triangles run alike, at most two on an edge, and
/// whose loops touch nowhere: the usual small patch. Returns whether it is one; otherwise `boundary` is as it
/// was.
bool small_patch_boundary(std::span<const Triangle> triangles, std::size_t vertex_bound, Workspace& workspace,
                          PatchBoundary& boundary);

}  // namespace meshcontour::detail
