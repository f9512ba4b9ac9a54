#pragma once

#include <span>
#include <vector>

namespace meshcontour::detail {

/// Where the vertices of a chain of edges that is cut in halves again and again come to lie.
struct CurveSplit {
  std::vector<double>
      places;  ///< 2^levels + 1: number of the chain's edge, with the share of it that is gone
  std::vector<double> shares;  ///< as many: the share of the chain's length up to there
};

/// Cuts at the vertices of a chain, near the middles of its parts; edges in equal parts only when no vertex
/// is left within a part. If there are no more than 2^levels edges, every vertex of the chain is hit.
///
/// @param lengths  of the chain's edges, one at least.
CurveSplit split_curve(std::span<const double> lengths, unsigned levels);

}  // namespace meshcontour::detail
