#pragma once

#include <span>
#include <vector>

#include "meshcontour/types.hpp"

namespace meshcontour::detail {

// Side 3 t + k of triangle t runs from its corner k to its corner (k + 1) % 3.
inline constexpr Index kNoSide = 0xFFFFFFFF;     // no other triangle on the edge
inline constexpr Index kManySides = 0xFFFFFFFE;  // two or more other triangles on the edge

inline Index triangle_of(Index side) {
  return side / 3;
}

inline Index next_side(Index side) {
  return side % 3 == 2 ? side - 2 : side + 1;
}

inline Index previous_side(Index side) {
  return side % 3 == 0 ? side + 2 : side - 1;
}

inline Index side_start(std::span<const Triangle> triangles, Index side) {
  return triangles[side / 3][side % 3];
}

inline Index side_end(std::span<const Triangle> triangles, Index side) {
  return side_start(triangles, next_side(side));
}

/// True for a side that shares its edge with exactly one other side.
inline bool is_paired(Index opposite) {
  return opposite < kManySides;
}

/// The neighbours of triangles across their sides.
struct Adjacency {
  std::vector<Index> opposite;        ///< one a side: the other side on the edge, kNoSide or kManySides
  std::size_t nonmanifold_edges = 0;  ///< edges with three or more triangles
};

/// Pairs the sides of triangles by their edge, whatever their direction; linear but for a sort of the edges
/// at each point. Sides without length (a repeated index) have no neighbour.
///
/// @param points  every index of a triangle is below it.
/// @throws Error  OutOfMemory when there are more sides than an Index can name.
Adjacency side_adjacency(std::span<const Triangle> triangles, std::size_t points, unsigned threads);

}  // namespace meshcontour::detail
