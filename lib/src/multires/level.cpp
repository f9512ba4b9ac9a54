#include "multires/level.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "meshcontour/error.hpp"
#include "multires/patches.hpp"

namespace meshcontour::detail {
namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw Error(ErrorCode::BadData, what + ": not an orientable manifold");
}

// Halfedges of the same undirected edge side by side, in order of the smaller end and then of the larger one.
std::vector<std::pair<std::uint64_t, Index>> sorted_halfedges(const MeshLevel& level) {
  std::vector<std::pair<std::uint64_t, Index>> keys;
  keys.reserve(3 * level.triangles.size());
  for (Index h = 0; h < 3 * level.triangles.size(); ++h) {
    const auto [low, high] = std::minmax({level.start(h), level.end(h)});
    if (low == high) refuse(fmt::format("a triangle has vertex {} twice", low));
    keys.emplace_back(std::uint64_t{low} << 32 | high, h);
  }
  std::ranges::sort(keys);
  return keys;
}

void find_twins(MeshLevel& level) {
  level.twins.assign(3 * level.triangles.size(), MeshLevel::kNone);
  const auto keys = sorted_halfedges(level);
  for (std::size_t i = 0; i < keys.size();) {
    std::size_t j = i + 1;
    while (j < keys.size() && keys[j].first == keys[i].first) ++j;
    const Index h = keys[i].second;
    if (j - i > 2) refuse(fmt::format("edge {}-{} has {} triangles", level.start(h), level.end(h), j - i));
    if (j - i == 2) {
      const Index twin = keys[i + 1].second;
      if (level.start(h) == level.start(twin)) {
        refuse(fmt::format("two triangles run along edge {}-{} the same way", level.start(h), level.end(h)));
      }
      level.twins[h] = twin;
      level.twins[twin] = h;
    }
    i = j;
  }
}

void number_edges(MeshLevel& level) {
  level.edges.assign(level.twins.size(), MeshLevel::kNone);
  level.first_halfedge.reserve(level.twins.size() / 2 + 1);
  for (Index h = 0; h < level.twins.size(); ++h) {
    const Index twin = level.twins[h];
    if (twin != MeshLevel::kNone && twin < h) {
      level.edges[h] = level.edges[twin];
    } else {
      level.edges[h] = static_cast<Index>(level.first_halfedge.size());
      level.first_halfedge.push_back(h);
    }
  }
}

// Needs twins, edges and sharp.
void describe_vertices(MeshLevel& level) {
  level.outgoing.assign(level.vertex_count, MeshLevel::kNone);
  level.sharp_edges.assign(level.vertex_count, 0);
  level.valences.assign(level.vertex_count, 0);
  for (const Index h : level.first_halfedge) {
    const bool sharp = level.is_sharp(h);
    for (const Index v : {level.start(h), level.end(h)}) {
      ++level.valences[v];
      if (sharp && level.sharp_edges[v] < 255) ++level.sharp_edges[v];
    }
  }
  for (Index h = 0; h < level.twins.size(); ++h) {
    Index& out = level.outgoing[level.start(h)];
    // Counter-clockwise from a border halfedge the whole fan is seen, so that one wins.
    const auto rank = [&](Index g) { return level.twins[g] == MeshLevel::kNone ? 2 : level.is_sharp(g) ? 1 : 0; };
    if (out == MeshLevel::kNone || rank(h) > rank(out)) out = h;
  }
}

// Every vertex must be reached by one walk around it.
void check_fans(const MeshLevel& level) {
  std::vector<std::uint32_t> triangles(level.vertex_count, 0);
  for (const Triangle& t : level.triangles) {
    for (const Index v : t) ++triangles[v];
  }
  for (Index v = 0; v < level.vertex_count; ++v) {
    if (level.outgoing[v] == MeshLevel::kNone) continue;
    std::uint32_t seen = 0;
    Index h = level.outgoing[v];
    do {
      ++seen;
      h = level.twins[MeshLevel::previous(h)];
    } while (h != MeshLevel::kNone && h != level.outgoing[v]);
    if (seen != triangles[v]) refuse(fmt::format("several fans of triangles meet in vertex {}", v));
  }
}

// A child's twin inside its parent, or kNone for the halves of the parent's edges.
Index inner_twin(Index f, Index child, Index k) {
  if (child == 3) return 3 * (4 * f + (k + 1) % 3) + (k + 2) % 3;
  // Child c has its inner edge opposite its own corner c.
  return k == (child + 1) % 3 ? 3 * (4 * f + 3) + (child + 2) % 3 : MeshLevel::kNone;
}

}  // namespace

MeshLevel make_level(std::span<const Triangle> triangles, Index vertex_count,
                     const std::function<bool(std::size_t, std::size_t)>& is_crease) {
  MeshLevel level;
  level.vertex_count = vertex_count;
  level.triangles.assign(triangles.begin(), triangles.end());
  find_twins(level);
  number_edges(level);
  level.sharp.resize(level.edge_count());
  for (std::size_t e = 0; e < level.edge_count(); ++e) {
    const Index h = level.first_halfedge[e], twin = level.twins[h];
    level.sharp[e] = twin == MeshLevel::kNone || is_crease(h / 3, twin / 3);
  }
  describe_vertices(level);
  check_fans(level);
  return level;
}

MeshLevel make_level(const Shell& shell, bool patch_borders) {
  const std::vector<std::size_t> patches = patch_of_triangles(shell);
  return make_level(shell.triangles, static_cast<Index>(shell.points.size()),
                    [&](std::size_t f, std::size_t g) { return patch_borders && patches[f] != patches[g]; });
}

MeshLevel quadrisected(const MeshLevel& level) {
  MeshLevel fine;
  fine.vertex_count = level.vertex_count + static_cast<Index>(level.edge_count());
  const std::size_t count = level.triangles.size();
  fine.triangles.resize(4 * count);
  fine.twins.assign(12 * count, MeshLevel::kNone);
  for (Index f = 0; f < count; ++f) {
    const auto& [a, b, c] = level.triangles[f];
    const auto odd = [&](Index k) { return level.vertex_count + level.edges[3 * f + k]; };
    const Index p = odd(0), q = odd(1), r = odd(2);
    fine.triangles[4 * f] = {a, p, r};
    fine.triangles[4 * f + 1] = {p, b, q};
    fine.triangles[4 * f + 2] = {r, q, c};
    fine.triangles[4 * f + 3] = {p, q, r};
    for (Index k = 0; k < 3; ++k) {
      for (Index child = 0; child < 4; ++child) fine.twins[3 * (4 * f + child) + k] = inner_twin(f, child, k);
      // The first half of edge k lies in child k, the second in the next child; both as their halfedge k.
      const Index twin = level.twins[3 * f + k];
      if (twin == MeshLevel::kNone) continue;
      const Index g = twin / 3, m = twin % 3;
      fine.twins[3 * (4 * f + k) + k] = 3 * (4 * g + (m + 1) % 3) + m;
      fine.twins[3 * (4 * f + (k + 1) % 3) + k] = 3 * (4 * g + m) + m;
    }
  }
  number_edges(fine);
  fine.sharp.assign(fine.edge_count(), 0);
  for (Index h = 0; h < level.twins.size(); ++h) {
    if (!level.is_sharp(h)) continue;
    const Index f = h / 3, k = h % 3;
    fine.sharp[fine.edges[3 * (4 * f + k) + k]] = 1;
    fine.sharp[fine.edges[3 * (4 * f + (k + 1) % 3) + k]] = 1;
  }
  describe_vertices(fine);
  return fine;
}

}  // namespace meshcontour::detail
