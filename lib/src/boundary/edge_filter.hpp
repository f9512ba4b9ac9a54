#pragma once

#include <span>
#include <vector>

#include "boundary/workspace.hpp"
#include "meshcontour/boundary.hpp"

namespace meshcontour::detail {

/// The edges of a patch that are not shared by just two triangles running in opposite directions.
struct EdgeCensus {
  std::vector<BoundaryEdge> boundary;  ///< exactly one triangle; sorted by (from, to)
  std::size_t nonmanifold = 0;         ///< three or more triangles
  std::size_t inconsistent = 0;        ///< two triangles that run the same way
};

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

/// @param vertex_bound  above every index of the triangles, at most 2^31.
EdgeCensus census_of_edges(std::span<const Triangle> triangles, std::size_t vertex_bound,
                           Workspace& workspace);

}  // namespace meshcontour::detail
