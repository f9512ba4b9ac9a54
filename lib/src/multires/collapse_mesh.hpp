#pragma once

#include <cstdint>
#include <vector>

#include "meshcontour/model.hpp"

namespace meshcontour::detail {

/// The triangles of a shell, whatever they are, as a mesh whose edges can be collapsed.
///
/// Halfedge h = 3 t + k runs from corner k of triangle t to the next one. Every fan of triangles around a
/// point is a vertex of its own. An edge is sharp at a border, between patches and at a crease. What is no
/// manifold is held by fixed vertices: edges that other than two triangles share, or two that run along it
/// the same way, points with several fans, triangles that repeat an index. So is the first vertex of each
/// boundary loop of each patch, and every neighbour of a vertex at which such loops touch, so that loops keep
/// their numbering.
class CollapseMesh {
 public:
  static constexpr Index kNone = 0xffffffff;

  enum class Kind : std::uint8_t {
    Smooth,  ///< inside a patch
    Curve,   ///< between two sharp edges
    Fixed,   ///< stays where it is
  };

  explicit CollapseMesh(const Shell& shell, unsigned threads);

  static Index next(Index h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static Index previous(Index h) { return h % 3 == 0 ? h + 2 : h - 1; }
  Index start(Index h) const { return corners_[h]; }
  Index end(Index h) const { return corners_[next(h)]; }
  /// The halfedge on the other side, or kNone.
  Index twin(Index h) const { return twins_[h]; }
  bool is_alive(Index h) const { return corners_[h] != kNone; }
  bool is_sharp(Index h) const { return twins_[h] == kNone || sharp_[h] != 0; }
  Kind kind(Index v) const { return kinds_[v]; }
  const Point& point(Index v) const { return points_[v]; }
  std::size_t vertex_count() const { return points_.size(); }
  std::size_t halfedge_count() const { return corners_.size(); }
  std::size_t triangle_count() const { return triangle_count_; }
  std::uint32_t valence(Index v) const { return valences_[v]; }
  /// The point of the shell that a vertex was at the beginning.
  Index origin(Index v) const { return origin_[v]; }

  /// The halfedges that leave a vertex, counter-clockwise, from the border on where there is one.
  void outgoing(Index v, std::vector<Index>& halfedges) const;

  /// Whether the collapse of an edge keeps the topology of the surface, of its patches and of their borders:
  /// the link condition, for the surface and for the curves on it [Dey, Edelsbrunner, Guha & Nekhayev 1999].
  bool keeps_topology(Index h);

  /// Merges the ends of an edge at `position`; `removed` is one of them. The number of dead triangles is 1
  /// or 2.
  void collapse(Index h, Index removed, const Point& position);

  /// Whether an edge can be turned within its two triangles, so that it joins their tips, as far as topology
  /// goes.
  bool can_flip(Index h);

  /// Turns it: h runs from its old start to the tip across, the triangle's next halfedge along the new edge.
  void flip(Index h);

  /// The shell that remains, with points in their old order; names and colours are those of `before`, from
  /// which the mesh was made.
  Shell to_shell(const Shell& before) const;

 private:
  void pair_halfedges(const Shell& shell, unsigned threads, std::vector<bool>& fixed);
  void mark_sharp(const Shell& shell);
  void split_fans(const Shell& shell, std::vector<bool>& fixed);
  void find_kinds(const std::vector<bool>& fixed);
  std::size_t common_neighbours(Index u, Index v);
  void join(Index h, Index kept);
  std::vector<Index> vertices_by_origin(std::size_t points) const;
  void add_creases(const std::vector<Index>& number, Shell& shell) const;

  std::vector<Index> corners_, twins_;  // one a halfedge
  std::vector<std::uint8_t> sharp_;     // one a halfedge: 1 between patches, 2 at a crease
  std::vector<Index> origin_;           // of each vertex, in Shell::points
  std::vector<Point> points_;           // of each vertex
  std::vector<Index> leaving_;          // of each vertex: a halfedge
  std::vector<Kind> kinds_;
  std::vector<bool> on_border_;          // of each vertex
  std::vector<std::uint32_t> valences_;  // of each vertex: its edges
  std::size_t triangle_count_ = 0;
  std::vector<std::uint32_t> marks_;  // one a vertex; scratch of the link condition
  std::uint32_t mark_ = 0;
  std::vector<Index> ring_;
};

}  // namespace meshcontour::detail
