#include <algorithm>
#include <optional>

#include "meshcontour/error.hpp"
#include "meshcontour/wavelet.hpp"
#include "multires/level.hpp"
#include "multires/patches.hpp"

namespace meshcontour {
namespace {

using detail::MeshLevel;

constexpr Index kNone = MeshLevel::kNone;
constexpr std::uint32_t kOddValence = 6, kOddBorderValence = 4;

enum class Parity : std::uint8_t { Unknown, Even, Odd };

// One step back: the mesh whose quadrisection a mesh is. Vertices keep their numbers.
struct Step {
  std::vector<Triangle> triangles;
  std::vector<std::size_t> patches;  // of each triangle
  std::vector<Index>
      centres;  // of each triangle: the middle one of its four; halfedge 3 t + k lies on 3 c + k
};

// Tells the vertices of a coarser mesh from those on its edges [Taubin 2002].
class Parities {
 public:
  explicit Parities(const MeshLevel& level) : level_(level), parities_(level.vertex_count, Parity::Unknown) {}

  /// Whether there is such a colouring; where a part of the mesh has several the first that is found.
  bool find() {
    for (Index v = 0; v < level_.vertex_count; ++v) {
      const bool used = level_.outgoing[v] != kNone;
      if (used && !may_be_odd(v) && parities_[v] == Parity::Unknown && !spread(v)) return false;
      if (used && !may_be_odd(v) && parities_[v] != Parity::Even) return false;
    }
    for (Index h = 0; h < level_.twins.size(); h += 3) {
      if (parities_[level_.start(h)] == Parity::Unknown && !guess(h)) return false;
    }
    return true;
  }

  bool is_even(Index v) const { return parities_[v] == Parity::Even; }

 private:
  bool on_border(Index v) const { return level_.twins[level_.outgoing[v]] == kNone; }

  bool may_be_odd(Index v) const {
    return level_.valences[v] == (on_border(v) ? kOddBorderValence : kOddValence);
  }

  bool set(Index v, Parity parity) {
    if (parities_[v] == Parity::Unknown) {
      parities_[v] = parity;
      changed_.push_back(v);
      if (parity == Parity::Even) queue_.push_back(v);
    }
    return parities_[v] == parity && (parity == Parity::Even || may_be_odd(v));
  }

  // From an even vertex to all that it decides. What was set is taken back where that fails.
  bool spread(Index seed) {
    changed_.clear();
    queue_.clear();
    bool good = set(seed, Parity::Even);
    while (good && !queue_.empty()) {
      const Index v = queue_.back();
      queue_.pop_back();
      ring(v, around_);
      for (std::size_t i = 0; good && i < around_.size(); ++i)
        good = set(around_[i], Parity::Odd) && settle(around_[i], v);
    }
    if (!good) {
      for (const Index v : changed_) parities_[v] = Parity::Unknown;
    }
    return good;
  }

  // The ring of an odd vertex, one of whose even neighbours is known: the other lies opposite.
  bool settle(Index odd, Index even) {
    ring(odd, other_);
    const std::size_t count = other_.size();
    const auto at = static_cast<std::size_t>(std::ranges::find(other_, even) - other_.begin());
    const bool border = count == kOddBorderValence;
    if (border && at != 0 && at != 3) return false;
    const std::size_t opposite = border ? 3 - at : (at + 3) % count;
    for (std::size_t i = 0; i < count; ++i) {
      if (!set(other_[i], i == at || i == opposite ? Parity::Even : Parity::Odd)) return false;
    }
    return true;
  }

  // A part without irregular vertices: a corner of its first triangle is even, or the tip across one of its
  // sides.
  bool guess(Index h) {
    std::vector<Index> candidates = {level_.start(h), level_.start(h + 1), level_.start(h + 2)};
    for (Index side = h; side < h + 3; ++side) {
      if (level_.twins[side] != kNone) candidates.push_back(level_.opposite(level_.twins[side]));
    }
    return std::ranges::any_of(candidates, [&](Index v) { return spread(v); });
  }

  void ring(Index v, std::vector<Index>& out) const {
    out.clear();
    Index h = level_.outgoing[v];
    // A crease comes before the order of the fan, but a border before a crease.
    do {
      out.push_back(level_.end(h));
      const Index in = MeshLevel::previous(h);
      if (level_.twins[in] == kNone) out.push_back(level_.start(in));
      h = level_.twins[in];
    } while (h != kNone && h != level_.outgoing[v]);
  }

  const MeshLevel& level_;
  std::vector<Parity> parities_;
  std::vector<Index> changed_, queue_, around_, other_;
};

// The triangle around a middle one: its corners lie across the sides; false if one is missing or not even.
bool surround(const MeshLevel& level, const std::vector<std::size_t>& patches, const Parities& parities,
              Index centre, Triangle& triangle) {
  for (Index k = 0; k < 3; ++k) {
    const Index twin = level.twins[3 * centre + k];
    if (twin == kNone || patches[twin / 3] != patches[centre]) return false;
    triangle[(k + 1) % 3] = level.opposite(twin);
    if (!parities.is_even(triangle[(k + 1) % 3])) return false;
  }
  return true;
}

// Nothing if the mesh is no quadrisection.
std::optional<Step> step_back(const MeshLevel& level, const std::vector<std::size_t>& patches) {
  const std::size_t count = level.triangles.size();
  if (count == 0 || count % 4 != 0) return std::nullopt;
  Parities parities(level);
  if (!parities.find()) return std::nullopt;
  Step step;
  for (Index t = 0; t < count; ++t) {
    const auto even = std::ranges::count_if(level.triangles[t], [&](Index v) { return parities.is_even(v); });
    if (even > 1) return std::nullopt;
    if (even == 1) continue;
    Triangle triangle;
    if (!surround(level, patches, parities, t, triangle)) return std::nullopt;
    step.triangles.push_back(triangle);
    step.patches.push_back(patches[t]);
    step.centres.push_back(t);
  }
  return step.triangles.size() == count / 4 ? std::optional(std::move(step)) : std::nullopt;
}

MeshLevel level_of(const Step& step, Index vertex_count) {
  return detail::make_level(step.triangles, vertex_count,
                            [&](std::size_t f, std::size_t g) { return step.patches[f] != step.patches[g]; });
}

// The levels from the finest one, as given, to the coarsest.
struct Steps {
  std::vector<Step> steps;
  std::vector<MeshLevel> levels;
};

Steps all_steps(const Shell& shell) {
  Steps found;
  found.steps.push_back({shell.triangles, detail::patch_of_triangles(shell), {}});
  const auto points = static_cast<Index>(shell.points.size());
  found.levels.push_back(level_of(found.steps.back(), points));
  while (auto step = step_back(found.levels.back(), found.steps.back().patches)) {
    try {
      found.levels.push_back(level_of(*step, points));
    } catch (const Error&) {
      break;  // the coarser one is no manifold
    }
    found.steps.push_back(*std::move(step));
  }
  return found;
}

// Goes down the levels again in the order of quadrisected(): for each triangle the halfedge that is its
// first.
void number_vertices(const Steps& found, SubdivisionConnectivity& out) {
  std::size_t level = found.steps.size() - 1;
  std::vector<Index> first(found.steps[level].triangles.size());
  for (Index t = 0; t < first.size(); ++t) first[t] = 3 * t;
  MeshLevel canonical = detail::make_level(out.base, false);
  for (; level > 0; --level) {
    const MeshLevel& fine = found.levels[level - 1];
    const std::vector<Index>& centres = found.steps[level].centres;
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
  Steps found;
  try {
    found = all_steps(shell);
  } catch (const Error&) {
    return out;  // no manifold
  }
  out.levels = static_cast<unsigned>(found.steps.size() - 1);
  if (out.levels == 0) return out;
  const Step& coarsest = found.steps.back();
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
  number_vertices(found, out);
  return out;
}

}  // namespace meshcontour
