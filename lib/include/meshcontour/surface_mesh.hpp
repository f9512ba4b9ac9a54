#pragma once

// Opt-in: needs CGAL. The rest of the library's headers do not.

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include "meshcontour/model.hpp"

namespace meshcontour {

using SurfaceMesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;

}  // namespace meshcontour
