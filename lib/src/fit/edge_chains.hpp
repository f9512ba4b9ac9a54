#pragma once

#include <cstddef>
#include <vector>

#include "meshcontour/boundary.hpp"
#include "meshcontour/model.hpp"

namespace meshcontour::detail {

/// A maximal run of boundary edges between patch corners: the same patches meet along all of it.
struct EdgeChain {
  std::vector<Index> vertices;  ///< of the shell, as its first loop runs; closed: the first is not repeated
  bool closed = false;          ///< a whole loop without a patch corner
  bool shared = false;          ///< two or more patches meet along it
};

/// One part of a loop: a chain, run forwards or backwards.
struct ChainUse {
  std::size_t chain = 0;     ///< index into ShellChains::chains
  std::size_t position = 0;  ///< in the loop, of the chain's first vertex (of its last one when reversed)
  bool reversed = false;
};

/// The boundary of a shell as a graph: every edge of it once, and the loops as walks along the chains.
struct ShellChains {
  std::vector<EdgeChain> chains;                         ///< in the order in which the loops first use them
  std::vector<std::vector<std::vector<ChainUse>>> uses;  ///< by patch and loop, in loop order
};

/// Splits the loops of a shell at its patch corners: vertices where the set of patches along the boundary
/// changes, or where other than two boundary edges meet. Shells whose patches share no vertex are joined by
/// position. O(n log n) in the boundary edges.
ShellChains find_edge_chains(const Shell& shell, const ShellBoundary& boundary);

}  // namespace meshcontour::detail
