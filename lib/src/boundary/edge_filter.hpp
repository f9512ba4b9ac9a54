#pragma once

#include <span>
#include <vector>

#include "boundary/workspace.hpp"
#include "meshcontour/boundary.hpp"

namespace meshcontour::detail {

/// A 64-bit mix with full avalanche (splitmix64, Steele, Lea & Flood 2014).
constexpr std::uint64_t mix(std::uint64_t v) {
  v += 0x9e3779b97f4a7c15u;
  v = (v ^ (v >> 30)) * 0xbf58476d1ce4e5b9u;
  v = (v ^ (v >> 27)) * 0x94d049bb133111ebu;
  return v ^ (v >> 31);
}

constexpr bool degenerate(const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

/// Counts the edges of a patch. The result stays valid until the next call with the same workspace.
///
/// Where up to 200 triangles, or some edge found, make it look at all edges, the counts are exact. Otherwise
/// edges with an even number of triangles, four or more, half of them running each way, are not seen; they
/// bound nothing.
///
/// @param vertex_bound  above every index of the triangles, at most 2^31.
const EdgeCensus& census_of_edges(std::span<const Triangle> triangles, std::size_t vertex_bound,
                                  Workspace& workspace);

}  // namespace meshcontour::detail
