#pragma once

#include <cstdint>
#include <vector>

#include "multires/chart_sequence.hpp"
#include "multires/collapse_mesh.hpp"

namespace meshcontour::detail {

/// A mesh that loses vertices one by one while every place on what is left keeps its place on the surface at
/// the beginning: successive self-parameterisation [Lee et al. 1998; Liu et al. 2020].
///
/// The triangles around a vertex are laid out in the plane before they are replaced; what would fold there is
/// not done. Sharp edges are laid out as straight lines by their length, so that curves stay curves.
class SelfParameterization {
 public:
  static constexpr std::uint32_t kMostEdges = 16;  ///< at a vertex that was merged with another

  /// @param shell          an orientable manifold.
  /// @param most_segments  of the shell's edges that one sharp edge may come to stand for.
  /// @param kept           one a point of the shell: whether it must stay.
  SelfParameterization(const Shell& shell, std::uint32_t most_segments, std::vector<bool> kept,
                       unsigned threads);

  const CollapseMesh& mesh() const { return mesh_; }

  /// Merges a vertex with a neighbour, which stays where it is; turns an edge before, where a sharp vertex
  /// has a single triangle on one side. False if topology, the plane or the shape of triangles stand against
  /// it.
  bool remove(Index v, Index kept);

  /// The vertices, in the beginning, along a sharp edge from its start to its end.
  std::vector<Index> curve(Index h) const;

  /// The sharp edges in the beginning, sorted: their ends, the smaller one first, and a halfedge.
  const std::vector<std::pair<std::array<Index, 2>, Index>>& sharp_edges() const { return sharp_edges_; }

  /// Where a place on a triangle that is left lies in the beginning; `triangle` is its number there, too.
  SurfacePlace origin(const SurfacePlace& place) const { return charts_.origin(place); }

 private:
  using PlanePoint = ChartSequence::PlanePoint;

  // What a sharp halfedge stands for.
  struct Chain {
    Index first = 0;  // the vertex behind its start, in the beginning
    std::uint32_t segments = 0;
    double length = 0;
    double sector = 0;  // angle on the surface from it to the next sharp edge around its start
  };

  // The triangles around a vertex: halfedges that leave it and the vertices where they end, with one more of
  // these at the border. `kept` and `other` are where among them the sharp edges end, or the one to go along.
  struct Ring {
    std::vector<Index> out, vertices;
    std::size_t kept = 0, other = 0;
    bool is_closed() const { return out.size() == vertices.size(); }
  };

  double sector(Index h) const;
  bool gather(Index v, Index kept);
  Index halfedge_to(std::size_t place) const;
  bool is_sharp(std::size_t place) const { return mesh_.is_sharp(halfedge_to(place)); }
  const Chain& chain_to(std::size_t place) const;
  bool clear_ears();
  bool keeps_sectors(Index h) const;
  bool fits_between(Index first, Index second) const;
  bool bends_little() const;
  bool flip(Index h);
  bool lay_out(bool curve);
  void turn_to_lines();
  bool stays_unfolded() const;
  bool keeps_shape(Index v, Index kept) const;
  void record();
  void join_chains(Index h);
  void extend_chain(Index v);

  CollapseMesh mesh_;
  ChartSequence charts_;
  std::uint32_t most_segments_;
  std::vector<bool> kept_;  // of the shell's points
  std::vector<std::pair<std::array<Index, 2>, Index>> sharp_edges_;
  std::vector<std::array<Index, 2>> along_;  // of each vertex of a curve: its neighbours in the beginning
  std::vector<Chain> chains_;                // of each halfedge
  Ring ring_;
  std::vector<double> angles_;     // of the ring's vertices in the chart
  std::vector<PlanePoint> plane_;  // the vertex itself, then those of its ring
  std::vector<ChartSequence::Face> before_, after_;
};

}  // namespace meshcontour::detail
