#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "meshcontour/types.hpp"

namespace meshcontour::detail {

constexpr std::size_t kVertexLimit = std::size_t{1} << 31;  // vertex indices stay below it

/// One above the largest index; 0 without triangles.
inline std::size_t vertex_bound(std::span<const Triangle> triangles) {
  Index largest = 0;
  for (const auto& [a, b, c] : triangles) largest = std::max({largest, a, b, c});
  return triangles.empty() ? 0 : std::size_t{largest} + 1;
}

/// Whether arrays that are indexed by vertex cost no more than the triangles call for.
constexpr bool is_dense(std::size_t bound, std::size_t triangles) {
  return bound < kVertexLimit && bound <= 64 * triangles + (std::size_t{1} << 20);
}

/// The vertices of some triangles, numbered from 0 in their own order.
class Numbering {
 public:
  explicit Numbering(std::span<const Triangle> triangles) {
    vertices_.reserve(3 * triangles.size());
    for (const Triangle& t : triangles) vertices_.insert(vertices_.end(), t.begin(), t.end());
    std::ranges::sort(vertices_);
    vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
  }

  std::size_t size() const { return vertices_.size(); }
  Index vertex(Index number) const { return vertices_[number]; }

  /// The number of a vertex; that of the next larger one if it is not there.
  Index number(Index vertex) const {
    return static_cast<Index>(std::ranges::lower_bound(vertices_, vertex) - vertices_.begin());
  }

  std::vector<Triangle> numbered(std::span<const Triangle> triangles) const {
    std::vector<Triangle> result(triangles.begin(), triangles.end());
    for (Triangle& t : result) {
      for (Index& v : t) v = number(v);
    }
    return result;
  }

 private:
  std::vector<Index> vertices_;
};

}  // namespace meshcontour::detail
