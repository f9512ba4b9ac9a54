#include "multires/level.hpp"

#include <fmt/format.h>

#include <array>

#include "multires/patches.hpp"
#include "multires/twins.hpp"

namespace meshcontour::detail {
namespace {

// Where the halfedges of its children stand behind 12 f, for triangle f.
constexpr std::array<Index, 3> kFirstHalf = {0, 4, 8}, kSecondHalf = {3, 7, 2};  // of its edges
// The first that leaves the odd vertex of an edge inside it.
constexpr std::array<Index, 3> kFromOdd = {1, 5, 2};
struct InnerEdge {
  Index halfedge, twin;
};
constexpr std::array<InnerEdge, 3> kInnerEdges = {{{1, 11}, {5, 9}, {6, 10}}};  // around the middle one

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
  // Counter-clockwise from a border halfedge the whole fan is seen, so that one wins.
  const auto rank = [&](Index h) {
    return level.twins[h] == MeshLevel::kNone ? 2 : level.is_sharp(h) ? 1 : 0;
  };
  for (Index h = 0; h < level.twins.size(); ++h) {
    const Index v = level.start(h);
    const int own = rank(h);
    const auto count = [&](Index at) {
      ++level.valences[at];
      if (own > 0 && level.sharp_edges[at] < 255) ++level.sharp_edges[at];
    };
    count(v);
    if (own == 2) count(level.end(h));  // no halfedge comes back
    Index& out = level.outgoing[v];
    if (out == MeshLevel::kNone || (own > 0 && own > rank(out))) out = h;
  }
}

// Every vertex must be reached by one walk around it.
void check_fans(const MeshLevel& level) {
  for (Index v = 0; v < level.vertex_count; ++v) {
    const Index first = level.outgoing[v];
    if (first == MeshLevel::kNone) continue;
    std::uint32_t edges = 0;
    Index h = first;
    do {
      ++edges;
      h = level.twins[MeshLevel::previous(h)];
    } while (h != MeshLevel::kNone && h != first);
    if (h == MeshLevel::kNone) ++edges;
    if (edges != level.valences[v]) {
      refuse_as_manifold(fmt::format("several fans of triangles meet in vertex {}", v));
    }
  }
}

// The opposite halfedges after quadrisection.
std::vector<Index> refined_twins(const MeshLevel& level) {
  std::vector<Index> twins(4 * level.twins.size(), MeshLevel::kNone);
  for (Index f = 0; f < level.triangles.size(); ++f) {
    for (const auto& [h, twin] : kInnerEdges) {
      twins[12 * f + h] = 12 * f + twin;
      twins[12 * f + twin] = 12 * f + h;
    }
    for (Index k = 0; k < 3; ++k) {
      const Index twin = level.twins[3 * f + k];
      if (twin == MeshLevel::kNone) continue;
      const Index g = twin / 3, m = twin % 3;
      twins[12 * f + kFirstHalf[k]] = 12 * g + kSecondHalf[m];
      twins[12 * f + kSecondHalf[k]] = 12 * g + kFirstHalf[m];
    }
  }
  return twins;
}

// What describe_vertices() would find: even vertices stay what they are, odd ones are regular.
void refine_vertices(const MeshLevel& level, MeshLevel& fine) {
  fine.outgoing.reserve(fine.vertex_count);
  for (const Index h : level.outgoing) {
    fine.outgoing.push_back(h == MeshLevel::kNone ? h : 12 * (h / 3) + kFirstHalf[h % 3]);
  }
  fine.valences.reserve(fine.vertex_count);
  fine.valences = level.valences;
  fine.sharp_edges.reserve(fine.vertex_count);
  fine.sharp_edges = level.sharp_edges;
  for (Index e = 0; e < level.edge_count(); ++e) {
    const Index h = level.first_halfedge[e];
    const bool sharp = level.sharp[e] != 0;
    fine.outgoing.push_back(12 * (h / 3) + (sharp ? kSecondHalf : kFromOdd)[h % 3]);
    fine.valences.push_back(level.twins[h] == MeshLevel::kNone ? 4 : 6);
    fine.sharp_edges.push_back(sharp ? 2 : 0);
  }
}

}  // namespace

MeshLevel make_level(std::span<const Triangle> triangles, Index vertex_count,
                     const std::function<bool(std::size_t, std::size_t)>& is_crease) {
  MeshLevel level;
  level.vertex_count = vertex_count;
  level.triangles.assign(triangles.begin(), triangles.end());
  level.twins = find_twins(triangles, vertex_count);
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

std::vector<Triangle> quadrisected_triangles(const MeshLevel& level) {
  std::vector<Triangle> fine;
  fine.reserve(4 * level.triangles.size());
  for (Index f = 0; f < level.triangles.size(); ++f) {
    const auto& [a, b, c] = level.triangles[f];
    const auto odd = [&](Index k) { return level.vertex_count + level.edges[3 * f + k]; };
    const Index p = odd(0), q = odd(1), r = odd(2);
    for (const Triangle& child : {Triangle{a, p, r}, {p, b, q}, {r, q, c}, {p, q, r}}) fine.push_back(child);
  }
  return fine;
}

MeshLevel quadrisected(const MeshLevel& level) {
  MeshLevel fine;
  fine.vertex_count = level.vertex_count + static_cast<Index>(level.edge_count());
  fine.triangles = quadrisected_triangles(level);
  fine.twins = refined_twins(level);
  number_edges(fine);
  fine.sharp.assign(fine.edge_count(), 0);
  for (Index e = 0; e < level.edge_count(); ++e) {
    if (!level.sharp[e]) continue;
    const Index h = level.first_halfedge[e];
    for (const auto& half : {kFirstHalf, kSecondHalf}) fine.sharp[fine.edges[12 * (h / 3) + half[h % 3]]] = 1;
  }
  refine_vertices(level, fine);
  return fine;
}

}  // namespace meshcontour::detail
