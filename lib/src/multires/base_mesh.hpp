#pragma once

#include <cstddef>

#include "multires/self_parameterization.hpp"

namespace meshcontour::detail {

/// Removes vertices in the order of the quadric errors of going to a neighbour, short ways first where these
/// are alike, until so many triangles are left or none can be removed.
void coarsen(SelfParameterization& surface, const Point& centre, std::size_t triangles);

}  // namespace meshcontour::detail
