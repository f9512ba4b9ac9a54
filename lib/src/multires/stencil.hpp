#pragma once

#include <utility>
#include <vector>

#include "meshcontour/subdivision.hpp"
#include "multires/level.hpp"

namespace meshcontour::detail {

/// The modified butterfly rule of a mesh: which even vertices give the odd vertex of an edge, and with what weights.
///
/// At a sharp edge (border or crease) the 4-point rule along it; it names vertices of sharp edges only. Elsewhere the
/// 8-point rule at regular ends, the rule of an extraordinary end, or the mean of two. Neighbours are taken in
/// combinatorial order, never sorted by angle. [Dyn, Levin & Gregory 1990; Zorin, Schroeder & Sweldens 1996]
class Stencils {
 public:
  using Term = std::pair<Index, double>;  ///< vertex and weight

  Stencils(const MeshLevel& level, BoundaryRule rule) : level_(level), rule_(rule) {}

  /// Replaces `terms` by the stencil of an edge. The weights sum to 1; a vertex may occur more than once; the order is
  /// fixed.
  void of_edge(Index edge, std::vector<Term>& terms) const;

 private:
  void add_sharp(Index h, std::vector<Term>& terms) const;
  void add_regular(Index h, std::vector<Term>& terms) const;
  void add_wing(Index h, std::vector<Term>& terms) const;
  void add_extraordinary(Index h, double scale, std::vector<Term>& terms) const;
  void add_trigonometric(Index h, double scale, std::vector<Term>& terms) const;
  bool uses_ring(Index h) const;
  Index sharp_neighbour(Index v, Index except) const;

  const MeshLevel& level_;
  BoundaryRule rule_;
};

}  // namespace meshcontour::detail
