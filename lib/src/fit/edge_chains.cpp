#include "fit/edge_chains.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <span>
#include <tuple>

namespace meshcontour::detail {

namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

// One use of an undirected boundary edge by a loop.
struct ChordUse {
  Index low, high;
  std::size_t patch;
  std::size_t position;  // among the chords of all loops
  auto key() const { return std::tie(low, high, patch, position); }
};

std::size_t chord_count(const BoundaryLoop& loop) {
  const std::size_t n = loop.vertices.size();
  return loop.closed ? n : n - std::min<std::size_t>(n, 1);
}

// The chains of one shell while they are found. `name[v]` stands for the vertex v: itself, or the first
// vertex at its position when the shell is joined by position.
class ChainFinder {
 public:
  ChainFinder(const Shell& shell, const ShellBoundary& boundary, std::span<const Index> name)
      : shell_(shell), boundary_(boundary), name_(name) {
    collect_chords();
    mark_corners();
  }

  bool any_shared() const { return any_shared_; }

  ShellChains chains() {
    ShellChains result;
    chain_of_.assign(first_use_.size(), kNone);
    std::size_t first_chord = 0;
    for (const PatchBoundary& patch : boundary_.patches) {
      auto& loops = result.uses.emplace_back();
      for (const BoundaryLoop& loop : patch.loops) {
        walk_loop(loop, first_chord, result, loops.emplace_back());
        first_chord += chord_count(loop);
      }
    }
    return result;
  }

 private:
  void collect_chords() {
    std::vector<ChordUse> uses;
    for (std::size_t patch = 0; patch < boundary_.patches.size(); ++patch) {
      for (const BoundaryLoop& loop : boundary_.patches[patch].loops) {
        const std::size_t n = loop.vertices.size();
        for (std::size_t k = 0; k < chord_count(loop); ++k) {
          const Index a = name_[loop.vertices[k]], b = name_[loop.vertices[(k + 1) % n]];
          uses.push_back({std::min(a, b), std::max(a, b), patch, uses.size()});
        }
      }
    }
    std::sort(uses.begin(), uses.end(),
              [](const ChordUse& a, const ChordUse& b) { return a.key() < b.key(); });
    chord_of_.resize(uses.size());
    for (std::size_t i = 0; i < uses.size(); ++i) {
      const bool same = i > 0 && uses[i].low == uses[i - 1].low && uses[i].high == uses[i - 1].high;
      if (!same) {
        first_use_.push_back(i);
        ends_.push_back({uses[i].low, uses[i].high});
      } else {
        any_shared_ = true;
      }
      chord_of_[uses[i].position] = first_use_.size() - 1;
      patches_.push_back(uses[i].patch);
    }
  }

  std::span<const std::size_t> patches_of(std::size_t chord) const {
    const std::size_t last = chord + 1 < first_use_.size() ? first_use_[chord + 1] : patches_.size();
    return std::span(patches_).subspan(first_use_[chord], last - first_use_[chord]);
  }

  void mark_corners() {
    constexpr std::size_t none = kNone;
    std::vector<std::size_t> first(shell_.points.size(), none);
    std::vector<unsigned char> degree(shell_.points.size(), 0);
    corner_.assign(shell_.points.size(), false);
    for (std::size_t chord = 0; chord < ends_.size(); ++chord) {
      for (const Index v : ends_[chord]) {
        if (degree[v] < 3) ++degree[v];
        if (degree[v] == 1) first[v] = chord;
        if (degree[v] == 2 && !std::ranges::equal(patches_of(first[v]), patches_of(chord))) corner_[v] = true;
      }
    }
    for (std::size_t v = 0; v < degree.size(); ++v) {
      if (degree[v] == 1 || degree[v] > 2) corner_[v] = true;
    }
    for (const PatchBoundary& patch : boundary_.patches) {
      for (const BoundaryLoop& loop : patch.loops) {
        if (loop.closed || loop.vertices.empty()) continue;
        corner_[name_[loop.vertices.front()]] = true;
        corner_[name_[loop.vertices.back()]] = true;
      }
    }
  }

  // Splits one loop at its corners; `first_chord` is the position of its first chord.
  void walk_loop(const BoundaryLoop& loop, std::size_t first_chord, ShellChains& result,
                 std::vector<ChainUse>& uses) {
    const std::size_t n = loop.vertices.size(), chords = chord_count(loop);
    if (chords == 0) return;
    std::size_t start = 0;
    while (start < n && !corner_[name_[loop.vertices[start]]]) ++start;
    if (start == n) return uses.push_back(closed_use(loop, first_chord, result));
    for (std::size_t done = 0; done < chords;) {
      const std::size_t begin = start + done;
      std::size_t count = 1;
      while (done + count < chords && !corner_[name_[loop.vertices[(begin + count) % n]]]) ++count;
      uses.push_back(open_use(loop, first_chord, begin % n, count, result));
      done += count;
    }
  }

  // Which way `count` chords of the loop from `begin` on run along a chain, if they are the chain. Where
  // patches are joined by position, loops may turn back on themselves, and share chords of a chain without
  // being it.
  std::optional<ChainUse> use_of(std::size_t chain, const EdgeChain& known, const BoundaryLoop& loop,
                                 std::size_t begin, std::size_t count) const {
    const std::size_t n = loop.vertices.size(), last = known.vertices.size() - 1;
    if (known.vertices.size() != (known.closed ? count : count + 1)) return std::nullopt;
    const auto runs_along = [&](bool reversed) {
      for (std::size_t k = 0; k <= last; ++k) {
        const std::size_t steps = !reversed ? k : known.closed ? n - k : last - k;
        if (name_[loop.vertices[(begin + steps) % n]] != name_[known.vertices[k]]) return false;
      }
      return true;
    };
    if (runs_along(false)) return ChainUse{chain, begin, false};
    if (runs_along(true)) return ChainUse{chain, begin, true};
    return std::nullopt;
  }

  ChainUse closed_use(const BoundaryLoop& loop, std::size_t first_chord, ShellChains& result) {
    const std::size_t n = loop.vertices.size(), chain = chain_of_[chord_of_[first_chord]];
    if (chain != kNone && result.chains[chain].closed) {
      const EdgeChain& known = result.chains[chain];
      std::size_t position = 0;
      while (position + 1 < n && name_[loop.vertices[position]] != name_[known.vertices[0]]) ++position;
      if (const auto use = use_of(chain, known, loop, position, n)) return *use;
    }
    for (std::size_t k = 0; k < n; ++k) chain_of_[chord_of_[first_chord + k]] = result.chains.size();
    const bool shared = patches_of(chord_of_[first_chord]).size() > 1;
    result.chains.push_back({{loop.vertices.begin(), loop.vertices.end()}, true, shared});
    return {result.chains.size() - 1, 0, false};
  }

  ChainUse open_use(const BoundaryLoop& loop, std::size_t first_chord, std::size_t begin, std::size_t count,
                    ShellChains& result) {
    const std::size_t n = loop.vertices.size(), chords = chord_count(loop);
    const std::size_t chain = chain_of_[chord_of_[first_chord + begin]];
    if (chain != kNone && !result.chains[chain].closed) {
      if (const auto use = use_of(chain, result.chains[chain], loop, begin, count)) return *use;
    }
    for (std::size_t k = 0; k < count; ++k) {
      chain_of_[chord_of_[first_chord + (begin + k) % chords]] = result.chains.size();
    }
    EdgeChain& made = result.chains.emplace_back();
    for (std::size_t k = 0; k <= count; ++k) made.vertices.push_back(loop.vertices[(begin + k) % n]);
    made.shared = patches_of(chord_of_[first_chord + begin]).size() > 1;
    return {result.chains.size() - 1, begin, false};
  }

  const Shell& shell_;
  const ShellBoundary& boundary_;
  std::span<const Index> name_;
  std::vector<std::size_t> chord_of_;       // by position: the number of the undirected chord
  std::vector<std::size_t> first_use_;      // by chord, into patches_
  std::vector<std::size_t> patches_;        // of all uses, sorted by chord and patch
  std::vector<std::array<Index, 2>> ends_;  // by chord
  std::vector<std::size_t> chain_of_;       // by chord
  std::vector<bool> corner_;                // by vertex name
  bool any_shared_ = false;
};

// For each point the first one with the same coordinates.
std::vector<Index> names_by_position(const Shell& shell) {
  std::vector<Index> order(shell.points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<Index>(i);
  const auto key = [&](Index v) {
    const Point& p = shell.points[v];
    return std::make_tuple(p.x(), p.y(), p.z());
  };
  std::sort(order.begin(), order.end(),
            [&](Index a, Index b) { return key(a) != key(b) ? key(a) < key(b) : a < b; });
  std::vector<Index> name(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && key(order[i]) == key(order[i - 1]);
    name[order[i]] = same ? name[order[i - 1]] : order[i];
  }
  return name;
}

}  // namespace

ShellChains find_edge_chains(const Shell& shell, const ShellBoundary& boundary) {
  std::vector<Index> name(shell.points.size());
  for (std::size_t i = 0; i < name.size(); ++i) name[i] = static_cast<Index>(i);
  ChainFinder by_index(shell, boundary, name);
  if (by_index.any_shared() || boundary.patches.size() < 2) return by_index.chains();
  name = names_by_position(shell);
  return ChainFinder(shell, boundary, name).chains();
}

}  // namespace meshcontour::detail
