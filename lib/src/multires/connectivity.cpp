#include <algorithm>
#include <array>
#include <optional>

#include "meshcontour/error.hpp"
#include "meshcontour/wavelet.hpp"
#include "multires/level.hpp"
#include "multires/patches.hpp"
#include "multires/twins.hpp"

namespace meshcontour {
namespace {

using detail::MeshLevel;

constexpr Index kNone = MeshLevel::kNone;
constexpr std::uint32_t kOddValence = 6, kOddBorderValence = 4;

// What counts of a level. Vertices keep the numbers of the finest one.
struct Connectivity {
  std::vector<Triangle> triangles;
  std::vector<Index> twins;
  std::vector<std::size_t> patches;  // of each triangle
  std::vector<Index> centres;        // of each triangle: in the next finer level the middle one of its four;
                                     // halfedge 3 t + k lies along 3 c + k

  Index start(Index h) const { return triangles[h / 3][h % 3]; }
};

// Gathers triangles by fours: a middle one and those across its sides, each at a corner of a coarser
// triangle. One four decides those around it, and so on [Taubin 2002].
class Fours {
 public:
  // even: the vertices that cannot lie on an edge of a coarser triangle.
  Fours(const Connectivity& mesh, const std::vector<bool>& even)
      : mesh_(mesh), even_(even), centre_(mesh.triangles.size(), kNone) {}

  // Whether all can be gathered; where a part of the mesh allows several ways, the first that is found.
  bool find() {
    for (Index h = 0; h < mesh_.twins.size(); ++h) {
      if (even_[mesh_.start(h)] && centre_[h / 3] == kNone && !spread(beside_corner(h))) return false;
    }
    for (Index h = 0; h < mesh_.twins.size(); h += 3) {
      if (centre_[h / 3] != kNone) continue;
      const std::array<Index, 4> seeds = {beside_corner(h), beside_corner(h + 1), beside_corner(h + 2), h};
      if (std::ranges::none_of(seeds, [&](Index seed) { return spread(seed); })) return false;
    }
    return true;
  }

  bool is_centre(Index t) const { return centre_[t] == t; }

  // Beyond the coarse edge along a halfedge of a middle triangle: the halfedge of the next middle one along
  // it, kNone at a border; nothing if the two halves of the edge do not lead to the same.
  std::optional<Index> neighbour(Index h) const {
    const auto& twins = mesh_.twins;
    const Index first = twins[MeshLevel::previous(twins[MeshLevel::previous(h)])];
    const Index second = twins[MeshLevel::next(twins[h])];
    if (first == kNone && second == kNone) return kNone;
    if (first == kNone || second == kNone) return std::nullopt;
    const Index across = twins[MeshLevel::previous(first)], other = twins[MeshLevel::next(second)];
    if (across == kNone || other == kNone || across != MeshLevel::next(other)) return std::nullopt;
    return across;
  }

 private:
  // The halfedge of the middle triangle beside the corner triangle whose even vertex the halfedge leaves.
  Index beside_corner(Index h) const { return mesh_.twins[MeshLevel::next(h)]; }

  // From a middle triangle, given by a halfedge, to all that it decides. What was gathered is let go where
  // that fails.
  bool spread(Index seed) {
    if (seed == kNone) return false;
    gathered_.clear();
    bool good = gather(seed / 3);
    for (std::size_t i = 0; good && i < gathered_.size(); ++i) {
      const Index h = 3 * gathered_[i];
      good = reach(h) && reach(h + 1) && reach(h + 2);
    }
    if (!good) {
      for (const Index centre : gathered_) release(centre);
    }
    return good;
  }

  bool reach(Index h) {
    const std::optional<Index> next = neighbour(h);
    return next && (*next == kNone || is_centre(*next / 3) || gather(*next / 3));
  }

  bool gather(Index centre) {
    if (centre_[centre] != kNone) return false;
    centre_[centre] = centre;
    gathered_.push_back(centre);
    for (Index h = 3 * centre; h < 3 * centre + 3; ++h) {
      const Index twin = mesh_.twins[h];
      if (twin == kNone || centre_[twin / 3] != kNone) return false;
      if (mesh_.patches[twin / 3] != mesh_.patches[centre]) return false;
      centre_[twin / 3] = centre;
    }
    return true;
  }

  void release(Index centre) {
    for (Index h = 3 * centre; h < 3 * centre + 3; ++h) {
      const Index twin = mesh_.twins[h];
      if (twin != kNone && centre_[twin / 3] == centre) centre_[twin / 3] = kNone;
    }
    centre_[centre] = kNone;
  }

  const Connectivity& mesh_;
  const std::vector<bool>& even_;
  std::vector<Index> centre_;  // of the four of each triangle
  std::vector<Index> gathered_;
};

// Whether the halfedges of the coarse triangles meet across the edges of the fours: in a very coarse mesh two
// edges may have the same ends.
bool same_twins(const Fours& fours, const std::vector<Index>& numbers, const Connectivity& coarse) {
  for (Index h = 0; h < coarse.twins.size(); ++h) {
    const Index beyond = *fours.neighbour(3 * coarse.centres[h / 3] + h % 3);
    if (coarse.twins[h] != (beyond == kNone ? kNone : 3 * numbers[beyond / 3] + beyond % 3)) return false;
  }
  return true;
}

// The mesh whose quadrisection a mesh is; nothing if there is none, or it is no manifold.
std::optional<Connectivity> coarser(const Connectivity& mesh, const std::vector<bool>& even) {
  const auto count = static_cast<Index>(mesh.triangles.size());
  if (count == 0 || count % 4 != 0) return std::nullopt;
  Fours fours(mesh, even);
  if (!fours.find()) return std::nullopt;
  Connectivity out;
  std::vector<Index> numbers(count, kNone);
  for (Index t = 0; t < count; ++t) {
    if (!fours.is_centre(t)) continue;
    numbers[t] = static_cast<Index>(out.triangles.size());
    const auto tip = [&](Index h) { return mesh.start(MeshLevel::previous(mesh.twins[h])); };
    out.triangles.push_back({tip(3 * t + 2), tip(3 * t), tip(3 * t + 1)});
    out.patches.push_back(mesh.patches[t]);
    out.centres.push_back(t);
  }
  try {
    out.twins = detail::find_twins(out.triangles, static_cast<Index>(even.size()));
  } catch (const Error&) {
    return std::nullopt;
  }
  return same_twins(fours, numbers, out) ? std::optional(std::move(out)) : std::nullopt;
}

// From the finest level, as given, to the coarsest.
std::vector<Connectivity> all_levels(const Shell& shell) {
  MeshLevel level = detail::make_level(shell, false);
  std::vector<bool> even(level.vertex_count, false);
  for (Index v = 0; v < level.vertex_count; ++v) {
    even[v] = level.valences[v] != (level.sharp_edges[v] > 0 ? kOddBorderValence : kOddValence);
  }
  std::vector<Connectivity> levels;
  levels.push_back(
      {std::move(level.triangles), std::move(level.twins), detail::patch_of_triangles(shell), {}});
  while (auto next = coarser(levels.back(), even)) levels.push_back(*std::move(next));
  return levels;
}

// Goes down the levels again in the order of quadrisected(): for each triangle the halfedge that is its
// first.
void number_vertices(const std::vector<Connectivity>& levels, SubdivisionConnectivity& out) {
  std::size_t level = levels.size() - 1;
  std::vector<Index> first(levels[level].triangles.size());
  for (Index t = 0; t < first.size(); ++t) first[t] = 3 * t;
  MeshLevel canonical = detail::make_level(out.base, false);
  for (; level > 0; --level) {
    const Connectivity& fine = levels[level - 1];
    const std::vector<Index>& centres = levels[level].centres;
    std::vector<Index> children(4 * first.size());
    out.order.resize(canonical.vertex_count + canonical.edge_count());
    for (std::size_t t = 0; t < first.size(); ++t) {
      Index centre = 3 * centres[first[t] / 3] + first[t] % 3;
      children[4 * t + 3] = centre;
      children[4 * t + 1] = MeshLevel::next(fine.twins[centre]);
      children[4 * t + 2] = fine.twins[MeshLevel::next(centre)];
      children[4 * t] = MeshLevel::previous(fine.twins[MeshLevel::previous(centre)]);
      for (std::size_t k = 0; k < 3; ++k, centre = MeshLevel::next(centre)) {
        out.order[canonical.vertex_count + canonical.edges[3 * t + k]] = fine.start(centre);
      }
    }
    first = std::move(children);
    if (level > 1) canonical = detail::quadrisected(canonical);
  }
}

}  // namespace

SubdivisionConnectivity find_subdivision(const Shell& shell) {
  SubdivisionConnectivity out;
  std::vector<Connectivity> levels;
  try {
    levels = all_levels(shell);
  } catch (const Error&) {
    return out;  // no manifold
  }
  out.levels = static_cast<unsigned>(levels.size() - 1);
  if (out.levels == 0) return out;
  const Connectivity& coarsest = levels.back();
  std::vector<Index> number(shell.points.size(), kNone);
  for (const Triangle& t : coarsest.triangles) {
    for (const Index v : t) number[v] = 0;
  }
  for (Index v = 0; v < number.size(); ++v) {
    if (number[v] == kNone) continue;
    number[v] = static_cast<Index>(out.order.size());
    out.order.push_back(v);
    out.base.points.push_back(shell.points[v]);
  }
  for (const Triangle& t : coarsest.triangles)
    out.base.triangles.push_back({number[t[0]], number[t[1]], number[t[2]]});
  out.base.id = shell.id;
  out.base.color = shell.color;
  out.base.patches = shell.patches;
  for (Patch& patch : out.base.patches) {
    patch.triangle_count >>= 2 * out.levels;
    patch.first_triangle >>= 2 * out.levels;
  }
  number_vertices(levels, out);
  return out;
}

}  // namespace meshcontour
