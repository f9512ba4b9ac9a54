#pragma once

#include <vector>

#include "meshcontour/model.hpp"

namespace meshcontour::detail {

/// The patch of each triangle.
std::vector<std::size_t> patch_of_triangles(const Shell& shell);

/// Marks the points that say in which order the loops of each patch come: the first vertex of each loop, the
/// ends of open chains, and where loops touch the vertices around. Loops keep their numbers when these stay.
void mark_loop_starts(const Shell& shell, std::vector<bool>& marked);

}  // namespace meshcontour::detail
