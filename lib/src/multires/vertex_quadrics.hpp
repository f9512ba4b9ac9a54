#pragma once

#include <vector>

#include "multires/collapse_mesh.hpp"
#include "multires/quadric.hpp"

namespace meshcontour::detail {

/// The middle of a shell's box.
Point box_centre(const Shell& shell);

/// The squared distances to the planes of the triangles at each vertex of a mesh, by their areas, and to
/// planes upright on them through its sharp edges; of points relative to `centre`. [Garland & Heckbert 1997,
/// section 6]
std::vector<Quadric> vertex_quadrics(const CollapseMesh& mesh, const Point& centre);

}  // namespace meshcontour::detail
