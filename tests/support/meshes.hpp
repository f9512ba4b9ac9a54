#pragma once

// Generated meshes whose topology is known, for tests.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "meshcontour/model.hpp"

namespace meshes {

using meshcontour::Index;
using meshcontour::Triangle;

/// Triangles over vertices 0 .. vertices-1, and what is known of them.
struct Mesh {
  std::string name;
  std::size_t vertices = 0;
  std::vector<Triangle> triangles;
  bool manifold = true;  ///< edges with at most two triangles, one fan a vertex
  bool orientable = true;
  std::optional<std::size_t> loops;  ///< boundary loops, where the construction gives their number
  int closed_euler = 0;              ///< V - E + F once every loop is closed by a disc; of manifold meshes
};

/// columns x rows squares of two triangles; every square whose column and row are both odd multiples of
/// `hole_pitch` is left out (0: none).
Mesh grid(Index columns, Index rows, Index hole_pitch = 0);

Mesh disc(Index triangles);                ///< a fan around an inner vertex
Mesh cylinder(Index around, Index along);  ///< open at both ends
Mesh torus(Index around, Index along);
Mesh sphere(Index around, Index along);       ///< closed, with poles
Mesh moebius(Index around, Index along = 1);  ///< 2 * around * along triangles
Mesh klein_bottle(Index around, Index along);
Mesh separate_triangles(Index count);
Mesh bow_tie(Index triangles);         ///< triangles that share one vertex and nothing else
Mesh pinched_tube(Index around);       ///< two cones that meet in their tips
Mesh touching_hole();                  ///< a square whose diamond hole touches the outer edge in a vertex
Mesh fin(Index triangles);             ///< triangles that share one edge
Mesh stacked_tetrahedra(Index count);  ///< closed tetrahedra that share one edge: 2 * count triangles on it
Mesh soup(Index vertices, Index triangles,
          std::uint32_t seed);  ///< random, degenerate and duplicate ones included

/// The same surface: triangles in another order, rotated, vertices renumbered with gaps.
Mesh shuffled(const Mesh& mesh, std::uint32_t seed);

/// The same surface with about one triangle in `one_in` turned over.
Mesh partly_flipped(const Mesh& mesh, std::uint32_t seed, std::uint32_t one_in);

/// Both meshes side by side, not connected.
Mesh united(const Mesh& a, const Mesh& b);

/// All of the above in several sizes.
std::vector<Mesh> family();

/// One patch that holds the mesh; the points are distinct and mean nothing.
meshcontour::Shell shell(const Mesh& mesh);

/// A model of one shell with a patch for each mesh, all over the same points.
meshcontour::Model model(const std::vector<Mesh>& patches);

}  // namespace meshes
