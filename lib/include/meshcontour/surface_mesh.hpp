#pragma once

// Opt-in: needs CGAL. The rest of the library's headers do not.

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <string_view>
#include <vector>

#include "meshcontour/model.hpp"

namespace meshcontour {

using SurfaceMesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;

/// The property maps of a SurfaceMesh made from a shell, by name and value type.
namespace property {
inline constexpr std::string_view kVertex = "v:index";  ///< Index: the vertex in Shell::points
inline constexpr std::string_view kNormal =
    "h:normal";  ///< Vector: at the corner that the halfedge points to
inline constexpr std::string_view kTriangle =
    "f:triangle";                                          ///< std::size_t: the triangle in Shell::triangles
inline constexpr std::string_view kPatch = "f:patch";      ///< std::size_t: the patch, from 0
inline constexpr std::string_view kColor = "f:color";      ///< CGAL::IO::Color: that of the patch
inline constexpr std::string_view kFlipped = "f:flipped";  ///< bool: the face runs against its triangle
}  // namespace property

/// Triangles as a halfedge mesh, as far as one can hold them.
struct HalfedgePatch {
  SurfaceMesh mesh;                   ///< vertices, halfedges and faces carry the maps of `property`
  std::size_t rejected_as_given = 0;  ///< triangles refused in their own orientation
  std::vector<std::size_t>
      unheld;  ///< triangles of the shell that fit in neither orientation; they are not in `mesh`
};

/// One patch of a shell as a halfedge mesh; linear.
///
/// Triangles are added as they run, by the rules of Surface_mesh::add_face. When one is refused, all are
/// oriented alike across the edges that two of them share and added anew; what is refused still, turned over
/// too, is listed in `unheld`: degenerate triangles, a third one on an edge, the cut of a one-sided surface.
/// Where several fans of triangles meet in a vertex, each has a vertex of its own in the mesh, with the same
/// index. Vertices on the border have a border halfedge as their own, so that border tests are O(1).
HalfedgePatch to_surface_mesh(const Shell& shell, std::size_t patch);

/// All patches of a shell as one halfedge mesh, as above.
HalfedgePatch to_surface_mesh(const Shell& shell);

/// A mesh as a shell: live vertices, and live faces grouped by patch, each group in the order of the mesh.
///
/// Patches, colours and corner normals follow the maps of `property` where the mesh has them; otherwise there
/// is one patch, and no normals. Flipped faces are turned back. Patches keep their numbers, so that some may
/// be empty.
///
/// @throws Error  BadData if a face is not a triangle.
Shell to_shell(const SurfaceMesh& mesh, std::string_view id);

}  // namespace meshcontour
