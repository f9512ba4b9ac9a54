#pragma once

#include "meshcontour/model.hpp"

namespace meshcontour::detail {

/// Moves the vertices of a mesh and flips its edges so that it lies nearer to a surface: in turn samples of
/// the surface find their places on the mesh, edges are flipped where that brings the samples around nearer,
/// and positions are solved for that make the sum of their squared distances least, of which shifts within
/// the surface count little [Hoppe et al. 1993; Pottmann & Hofer 2003].
///
/// Borders and edges between patches stay to the last bit, patches keep their numbers of triangles. No
/// triangle turns by more than 60 degrees at a step. O(n log n) in the triangles of the surface.
///
/// @param mesh     an orientable manifold, with the patches of the surface.
/// @param rounds   1 or more.
void fit_to_surface(Shell& mesh, const Shell& surface, int rounds, unsigned threads);

}  // namespace meshcontour::detail
