#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "meshcontour/subdivision.hpp"
#include "multires/level.hpp"

namespace meshcontour::detail {

/// The modified butterfly rule of a mesh: which even vertices give the odd vertex of an edge, and with what
/// weights.
///
/// At a sharp edge (border or crease) the 4-point rule along it; it names vertices of sharp edges only.
/// Elsewhere the 8-point rule at regular ends, the rule of an extraordinary end, or the mean of two.
/// Neighbours are taken in combinatorial order, never sorted by angle. [Dyn, Levin & Gregory 1990; Zorin,
/// Schroeder & Sweldens 1996]
class Stencils {
 public:
  using Term = std::pair<Index, double>;  ///< vertex and weight

  /// Vertices of the 8-point rule: the ends of the edge, the corners opposite it, then four wings.
  using Regular = std::array<Index, 8>;
  static constexpr double kEnd = 1.0 / 2, kOpposite = 1.0 / 8, kWing = -1.0 / 16;
  static constexpr double kCentre = 3.0 / 4;  // of an extraordinary vertex

  /// @param level  must stay where it is.
  Stencils(const MeshLevel& level, BoundaryRule rule);

  /// The stencil of an edge whose ends are both regular and touch nothing sharp, as nearly all do after some
  /// refinement; nothing for others. of_edge() gives the same.
  std::optional<Regular> regular(Index edge) const;

  /// Replaces `terms` by the stencil of an edge, without what hubs give; where there is none the weights sum
  /// to 1. A vertex may occur more than once; the order is fixed.
  void of_edge(Index edge, std::vector<Term>& terms) const;

  /// Inner vertices of so many edges that their stencils, each with all neighbours, would be too large
  /// together; what they give is left to add_hub_predictions().
  const std::vector<Index>& hubs() const { return hubs_; }

  /// An edge of a hub: the odd vertex in its middle, its other end, and the share of the hub's rule in it.
  struct Spoke {
    Index odd, end;
    double scale;
  };
  /// In cyclic order.
  std::vector<Spoke> spokes(Index hub) const;

  /// The same for the trigonometric rule: its vertex with so many triangles between two sharp edges.
  struct Fan {
    Index centre = 0, first = 0, last = 0;  ///< vertices; `first` and `last` are the ends of the sharp edges
    std::vector<Spoke> spokes;              ///< the edges between these, from the first to the last
  };
  /// The first halfedges of fans, on their first sharp edges.
  const std::vector<Index>& fans() const { return fans_; }
  Fan fan(Index first) const;

 private:
  void add_sharp(Index h, std::vector<Term>& terms) const;
  void add_regular(Index h, std::vector<Term>& terms) const;
  void add_wing(Index h, std::vector<Term>& terms) const;
  void add_extraordinary(Index h, double scale, std::vector<Term>& terms) const;
  void add_trigonometric(Index h, double scale, std::vector<Term>& terms) const;
  bool is_regular(Index v) const {
    return level_.sharp_edges[v] == 0 && level_.valences[v] == kRegularValence;
  }
  void find_sectors();
  bool uses_ring(Index h) const;
  Index sharp_neighbour(Index v, Index except) const;

  static constexpr std::uint32_t kRegularValence = 6;
  static constexpr std::size_t kLargestRing = 64;  // edges of a vertex that is no hub, triangles of no fan

  bool is_hub(Index v) const { return level_.sharp_edges[v] == 0 && level_.valences[v] > kLargestRing; }

  const MeshLevel& level_;
  BoundaryRule rule_;
  std::vector<Index> hubs_, fans_;
  // Of each halfedge that leaves a vertex of two sharp edges or more: the triangles between the two around
  // it, else 0. Empty for other rules than the trigonometric one.
  std::vector<std::uint32_t> sectors_;
  std::vector<std::vector<double>> weights_;  // of the ring around an extraordinary vertex, by its valence
};

inline std::optional<Stencils::Regular> Stencils::regular(Index edge) const {
  const Index h = level_.first_halfedge[edge], u = level_.start(h), v = level_.end(h);
  if (!is_regular(u) || !is_regular(v)) return std::nullopt;
  const Index twin = level_.twins[h];
  return Regular{u,
                 v,
                 level_.opposite(h),
                 level_.opposite(twin),
                 level_.tip(MeshLevel::next(h)),
                 level_.tip(MeshLevel::previous(h)),
                 level_.tip(MeshLevel::next(twin)),
                 level_.tip(MeshLevel::previous(twin))};
}

}  // namespace meshcontour::detail
