#pragma once

#include "boundary/workspace.hpp"
#include "meshcontour/boundary.hpp"

namespace meshcontour::detail {

/// The boundary of a patch from the border halfedges of a CGAL::Surface_mesh: of the triangles that it can
/// hold.
PatchBoundary halfedge_boundary(const Shell& shell, std::size_t patch, Workspace& workspace);

}  // namespace meshcontour::detail
