#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "meshcontour/model.hpp"

namespace meshcontour::detail {

/// Connectivity of a triangle 2-manifold with or without boundary, as flat arrays.
///
/// Halfedge h = 3 f + k runs from corner k of triangle f to the next one. Edges are numbered by first
/// appearance, triangle by triangle. Quadrisection gives edge e the odd vertex vertex_count + e, and triangle
/// f = (a, b, c) with the odd vertices p, q, r of ab, bc, ca the children 4f: (a, p, r), 4f+1: (p, b, q),
/// 4f+2: (r, q, c), 4f+3: (p, q, r).
struct MeshLevel {
  static constexpr Index kNone = 0xffffffff;

  Index vertex_count = 0;
  std::vector<Triangle> triangles;
  std::vector<Index> twins;           ///< 3 F: the opposite halfedge, or kNone at a border
  std::vector<Index> edges;           ///< 3 F: the edge of a halfedge
  std::vector<Index> first_halfedge;  ///< E: the halfedge at which the edge appeared
  std::vector<std::uint8_t> sharp;    ///< E: 1 at borders and creases
  std::vector<Index> outgoing;  ///< vertex_count: a halfedge that leaves the vertex, kNone at an isolated
                                ///< one; at a sharp vertex one along a sharp edge
  std::vector<std::uint8_t> sharp_edges;  ///< vertex_count: sharp edges at the vertex, 255 for more
  std::vector<std::uint32_t> valences;    ///< vertex_count: edges at the vertex

  static Index next(Index h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static Index previous(Index h) { return h % 3 == 0 ? h + 2 : h - 1; }
  Index start(Index h) const { return triangles[h / 3][h % 3]; }
  Index end(Index h) const { return triangles[h / 3][h % 3 == 2 ? 0 : h % 3 + 1]; }
  Index opposite(Index h) const { return triangles[h / 3][h % 3 == 0 ? 2 : h % 3 - 1]; }
  /// The vertex opposite an edge on its other side, which must have one.
  Index tip(Index h) const { return opposite(twins[h]); }
  bool is_sharp(Index h) const { return sharp[edges[h]] != 0; }
  /// The halfedge on the other side, kNone where the edge is sharp.
  Index across(Index h) const { return is_sharp(h) ? kNone : twins[h]; }
  std::size_t edge_count() const { return first_halfedge.size(); }
};

/// The level of a triangle list.
///
/// @param is_crease  called for the two triangles of each inner edge.
/// @throws Error     BadData naming the vertices of an edge with three or more triangles or two that run
///                   along it the same way, of a degenerate triangle, or a vertex where several fans meet.
MeshLevel make_level(std::span<const Triangle> triangles, Index vertex_count,
                     const std::function<bool(std::size_t, std::size_t)>& is_crease);

/// The level of a shell's triangles; edges between patches are sharp if wanted, creases inside patches are
/// not.
///
/// @throws Error  as above.
MeshLevel make_level(const Shell& shell, bool patch_borders = true);

/// The level after quadrisection, without hashing or sorting.
MeshLevel quadrisected(const MeshLevel& level);

/// Its triangles alone.
std::vector<Triangle> quadrisected_triangles(const MeshLevel& level);

}  // namespace meshcontour::detail
