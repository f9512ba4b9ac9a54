#include "fit/edge_chains.hpp"

#include "meshcontour/boundary.hpp"
#include "support/catch.hpp"

using namespace meshcontour;
using meshcontour::detail::ChainUse;
using meshcontour::detail::find_edge_chains;
using meshcontour::detail::ShellChains;

namespace {

// A prism over a regular polygon: bottom, top, and `walls` side patches of `steps` quadrilaterals each.
Shell prism(int walls, int steps) {
  Shell shell;
  const int n = walls * steps;
  for (const double z : {0.0, 1.0}) {
    for (int i = 0; i < n; ++i)
      shell.points.push_back({std::cos(6.283185307179586 * i / n), std::sin(6.283185307179586 * i / n), z});
  }
  const auto add_patch = [&](const std::vector<Triangle>& triangles) {
    shell.patches.push_back({"", {}, shell.triangles.size(), triangles.size()});
    shell.triangles.insert(shell.triangles.end(), triangles.begin(), triangles.end());
  };
  const auto low = [&](int i) { return static_cast<Index>(i % n); };
  const auto high = [&](int i) { return static_cast<Index>(n + i % n); };
  std::vector<Triangle> bottom, top;
  for (int i = 1; i + 1 < n; ++i) {
    bottom.push_back({low(0), low(i + 1), low(i)});
    top.push_back({high(0), high(i), high(i + 1)});
  }
  add_patch(bottom);
  add_patch(top);
  for (int w = 0; w < walls; ++w) {
    std::vector<Triangle> wall;
    for (int i = w * steps; i < (w + 1) * steps; ++i) {
      wall.push_back({low(i), low(i + 1), high(i + 1)});
      wall.push_back({low(i), high(i + 1), high(i)});
    }
    add_patch(wall);
  }
  return shell;
}

ShellChains chains_of(const Shell& shell) {
  Model model;
  model.shells.push_back(shell);
  std::vector<Diagnostic> diagnostics;
  return find_edge_chains(shell, extract_boundaries(model, {}, diagnostics)[0]);
}

// The vertices that a use says its loop visits.
std::vector<Index> walked(const ShellChains& chains, const ChainUse& use) {
  std::vector<Index> vertices = chains.chains[use.chain].vertices;
  if (use.reversed) std::reverse(vertices.begin(), vertices.end());
  return vertices;
}

}  // namespace

TEST_CASE("find_edge_chains: a prism has an edge for every pair of patches that meet", "[fit]") {
  const int walls = GENERATE(2, 3, 7), steps = GENERATE(1, 2, 5);
  if (walls * steps < 3) return;
  const ShellChains chains = chains_of(prism(walls, steps));
  CHECK(chains.chains.size() == static_cast<std::size_t>(3 * walls));
  for (const auto& chain : chains.chains) {
    CHECK(chain.shared);
    CHECK_FALSE(chain.closed);
    const std::size_t chords = chain.vertices.size() - 1;
    CHECK((chords == 1 || chords == static_cast<std::size_t>(steps)));
  }
}

TEST_CASE("find_edge_chains: every chain of a closed shell is used once in each direction", "[fit]") {
  const ShellChains chains = chains_of(prism(4, 3));
  std::vector<int> forward(chains.chains.size(), 0), backward(chains.chains.size(), 0);
  for (const auto& loops : chains.uses) {
    for (const auto& uses : loops) {
      for (const ChainUse& use : uses) ++(use.reversed ? backward : forward)[use.chain];
    }
  }
  CHECK(forward == std::vector<int>(chains.chains.size(), 1));
  CHECK(backward == forward);
}

TEST_CASE("find_edge_chains: the uses of a loop walk its vertices in order", "[fit]") {
  const Shell shell = prism(3, 4);
  Model model;
  model.shells.push_back(shell);
  std::vector<Diagnostic> diagnostics;
  const ShellBoundary boundary = extract_boundaries(model, {}, diagnostics)[0];
  const ShellChains chains = find_edge_chains(shell, boundary);
  for (std::size_t p = 0; p < boundary.patches.size(); ++p) {
    const SharedArray<Index>& loop = boundary.patches[p].loops[0].vertices;
    for (const ChainUse& use : chains.uses[p][0]) {
      const std::vector<Index> vertices = walked(chains, use);
      for (std::size_t i = 0; i < vertices.size(); ++i)
        CHECK(vertices[i] == loop[(use.position + i) % loop.size()]);
    }
  }
}

TEST_CASE("find_edge_chains: a tube's rims are closed chains shared with the lids", "[fit]") {
  Shell shell = prism(1, 8);  // one wall all around: its seam is inside the patch
  const ShellChains chains = chains_of(shell);
  REQUIRE(chains.chains.size() == 2);
  CHECK(chains.chains[0].closed);
  CHECK(chains.chains[0].shared);
  CHECK(chains.uses[2][0].size() == 1);
  CHECK(chains.uses[2][0][0].reversed);
}

TEST_CASE("find_edge_chains: patches without common vertices are joined where they coincide", "[fit]") {
  const Shell joined = prism(5, 2);
  Shell apart = joined;
  apart.points.clear();
  for (const Patch& patch : joined.patches) {
    const auto offset = static_cast<Index>(apart.points.size());
    apart.points.insert(apart.points.end(), joined.points.begin(), joined.points.end());
    for (std::size_t t = patch.first_triangle; t < patch.first_triangle + patch.triangle_count; ++t) {
      for (Index& v : apart.triangles[t]) v += offset;
    }
  }
  CHECK(chains_of(apart).chains.size() == chains_of(joined).chains.size());
}

TEST_CASE("find_edge_chains: a loop that turns back on itself lends its chain to none that goes on",
          "[fit]") {
  // All loops have points of their own. The first two run from x = 0 to 2 and back, from 4 to 2 and back; the
  // third runs from 0 to 4 and back.
  Shell shell;
  ShellBoundary boundary;
  std::vector<BoundaryLoop> loops;
  const auto add = [&](const std::vector<double>& places) {
    std::vector<Index> vertices;
    for (const double x : places) {
      vertices.push_back(static_cast<Index>(shell.points.size()));
      shell.points.push_back({x, 0, 0});
    }
    loops.push_back({vertices, true});
  };
  add({0, 1, 2, 1});
  add({4, 3, 2, 3});
  add({0, 1, 2, 3, 4, 3, 2, 1});
  boundary.patches.resize(2);
  boundary.patches[0].loops = loops;
  const ShellChains chains = find_edge_chains(shell, boundary);
  for (std::size_t l = 0; l < loops.size(); ++l) {
    const auto& loop = loops[l].vertices;
    std::size_t chords = 0;
    for (const ChainUse& use : chains.uses[0][l]) {
      const std::vector<Index> vertices = walked(chains, use);
      for (std::size_t k = 0; k < vertices.size(); ++k) {
        CHECK(shell.points[vertices[k]] == shell.points[loop[(use.position + k) % loop.size()]]);
      }
      chords += vertices.size() - 1;
    }
    CHECK(chords == loop.size());
  }
}
