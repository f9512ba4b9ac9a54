#pragma once

#include <span>
#include <vector>

#include "meshcontour/model.hpp"

namespace meshcontour {

/// How an edge near a boundary or a crease is split.
enum class BoundaryRule {
  Reflect,        ///< missing neighbours are mirrored across the boundary [Zorin, Schroeder & Sweldens 1996]
  Trigonometric,  ///< stencils of extraordinary boundary vertices, C1 there [Zorin & Schroeder 2000]
};

/// How colours and texture coordinates of new points follow from those around.
enum class AttributeRule {
  Midpoint,   ///< the mean of the ends of an edge
  Butterfly,  ///< as the points themselves; colours are held between 0 and 1
};

struct SubdivisionOptions {
  BoundaryRule boundary = BoundaryRule::Reflect;
  AttributeRule attributes = AttributeRule::Midpoint;
  bool creases = true;   ///< patch borders inside a shell stay curves of their own
  unsigned threads = 0;  ///< 0: one per processor
};

/// Weights of the neighbours of an interior vertex of valence K in the modified butterfly rule; the first
/// belongs to the other end of the edge that is split. They sum to 1/4; the vertex itself has 3/4. [Zorin,
/// Schroeder & Sweldens 1996, doi 10.1145/237170.237254]
///
/// @param valence  at least 3.
std::vector<double> butterfly_weights(std::size_t valence);

/// The shell after `levels` steps of modified butterfly subdivision: every triangle becomes four a step, old
/// points stay where they are and keep their numbers. Patches, colours and corner normals are inherited,
/// colours and texture coordinates of points by the rule chosen for them.
///
/// Border curves depend on border points alone; with `creases` so do the borders between patches.
///
/// @throws Error  BadData if the shell is not an orientable manifold (naming the vertex), Usage if the result
/// would
///                have more than 2^32 - 1 points.
Shell subdivided(const Shell& shell, unsigned levels, const SubdivisionOptions& options = {});

}  // namespace meshcontour
