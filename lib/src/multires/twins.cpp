#include "multires/twins.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "meshcontour/error.hpp"
#include "multires/level.hpp"

namespace meshcontour::detail {
namespace {

// Halfedges by the smaller end of their edge. Those of vertex v stand at first[v] .. first[v + 1] - 1, as the
// larger end above and the halfedge below in one number.
struct HalfedgesByVertex {
  std::vector<Index> first;
  std::vector<std::uint64_t> keys;
};

HalfedgesByVertex halfedges_by_vertex(std::span<const Triangle> triangles, Index vertex_count) {
  HalfedgesByVertex out;
  // Shifted by one while places are given out, so that it is right in the end.
  std::vector<Index>& first = out.first;
  first.assign(std::size_t{vertex_count} + 2, 0);
  for (const auto& [a, b, c] : triangles) {
    if (a == b || a == c) refuse_as_manifold(fmt::format("a triangle has vertex {} twice", a));
    if (b == c) refuse_as_manifold(fmt::format("a triangle has vertex {} twice", b));
    for (const Index low : {std::min(a, b), std::min(b, c), std::min(c, a)}) ++first[low + 2];
  }
  std::partial_sum(first.begin(), first.end(), first.begin());
  out.keys.resize(3 * triangles.size());
  Index h = 0;
  for (const auto& [a, b, c] : triangles) {
    for (const auto& [low, high] : {std::minmax(a, b), std::minmax(b, c), std::minmax(c, a)}) {
      out.keys[first[low + 1]++] = std::uint64_t{high} << 32 | h++;
    }
  }
  return out;
}

// Joins the halfedges of one edge.
void join(std::span<const Triangle> triangles, std::span<const std::uint64_t> keys,
          std::vector<Index>& twins) {
  if (keys.size() == 1) return;
  const auto start = [&](Index h) { return triangles[h / 3][h % 3]; };
  const auto h = static_cast<Index>(keys[0]), twin = static_cast<Index>(keys[1]);
  const auto high = static_cast<Index>(keys[0] >> 32);
  const Index end = start(h) == high ? start(MeshLevel::next(h)) : high;
  if (keys.size() > 2) {
    refuse_as_manifold(fmt::format("edge {}-{} has {} triangles", start(h), end, keys.size()));
  }
  if (start(h) == start(twin)) {
    refuse_as_manifold(fmt::format("two triangles run along edge {}-{} the same way", start(h), end));
  }
  twins[h] = twin;
  twins[twin] = h;
}

}  // namespace

void refuse_as_manifold(const std::string& what) {
  throw Error(ErrorCode::BadData, what + ": not an orientable manifold");
}

std::vector<Index> find_twins(std::span<const Triangle> triangles, Index vertex_count) {
  std::vector<Index> twins(3 * triangles.size(), MeshLevel::kNone);
  HalfedgesByVertex halfedges = halfedges_by_vertex(triangles, vertex_count);
  for (Index v = 0; v < vertex_count; ++v) {
    const std::span<std::uint64_t> keys(halfedges.keys.data() + halfedges.first[v],
                                        halfedges.first[v + 1] - halfedges.first[v]);
    std::ranges::sort(keys);
    for (std::size_t i = 0; i < keys.size();) {
      std::size_t j = i + 1;
      while (j < keys.size() && keys[j] >> 32 == keys[i] >> 32) ++j;
      join(triangles, keys.subspan(i, j - i), twins);
      i = j;
    }
  }
  return twins;
}

}  // namespace meshcontour::detail
