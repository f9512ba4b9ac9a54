#include "multires/stencil.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace meshcontour {

std::vector<double> butterfly_weights(std::size_t valence) {
  assert(valence >= 3);
  if (valence == 3) return {5.0 / 12, -1.0 / 12, -1.0 / 12};
  if (valence == 4) return {3.0 / 8, 0, -1.0 / 8, 0};
  const auto k = static_cast<double>(valence);
  std::vector<double> weights(valence);
  for (std::size_t j = 0; j < valence; ++j) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(j) / k;
    weights[j] = (0.25 + std::cos(angle) + 0.5 * std::cos(2 * angle)) / k;
  }
  return weights;
}

namespace detail {
namespace {

constexpr std::size_t kRegularSector = 3;  // triangles at a regular vertex of a straight border

// Weights of the ring 0..k of a border vertex with k triangles for its inner edge i [Zorin & Schroeder 2000];
// the vertex itself has what is missing to 1, here as the last entry.
std::vector<double> trigonometric_weights(std::size_t k, std::size_t i) {
  const double n = static_cast<double>(k), theta = std::numbers::pi / n, at = static_cast<double>(i) * theta;
  std::vector<double> weights(k + 2);
  weights[k + 1] = 1 - std::sin(theta) * std::sin(at) / (n * (1 - std::cos(theta)));
  weights[0] = std::cos(at) / 4 -
               std::sin(2 * theta) * std::sin(2 * at) / (4 * n * (std::cos(theta) - std::cos(2 * theta)));
  weights[k] = -weights[0];
  for (std::size_t j = 1; j < k; ++j) {
    const double other = static_cast<double>(j) * theta;
    weights[j] = (std::sin(at) * std::sin(other) + std::sin(2 * at) * std::sin(2 * other) / 2) / n;
  }
  return weights;
}

}  // namespace

Stencils::Stencils(const MeshLevel& level, BoundaryRule rule) : level_(level), rule_(rule) {
  std::size_t largest = 0;
  for (Index v = 0; v < level.vertex_count; ++v) {
    largest = std::max<std::size_t>(largest, level.valences[v]);
    if (is_hub(v)) hubs_.push_back(v);
  }
  weights_.resize(std::min(largest, kLargestRing) + 1);
  for (std::size_t valence = 3; valence < weights_.size(); ++valence) {
    weights_[valence] = butterfly_weights(valence);
  }
}

std::vector<Stencils::Spoke> Stencils::spokes(Index hub) const {
  std::vector<Spoke> out;
  const Index first = level_.outgoing[hub];
  Index h = first;
  do {
    const double scale = uses_ring(level_.twins[h]) ? 0.5 : 1;
    out.push_back({level_.vertex_count + level_.edges[h], level_.end(h), scale});
    h = level_.twins[MeshLevel::previous(h)];
  } while (h != first);
  return out;
}

void Stencils::of_edge(Index edge, std::vector<Term>& terms) const {
  terms.clear();
  const Index h = level_.first_halfedge[edge];
  if (level_.sharp[edge]) return add_sharp(h, terms);
  const Index twin = level_.twins[h];
  const bool at_start = uses_ring(h), at_end = uses_ring(twin);
  if (!at_start && !at_end) return add_regular(h, terms);
  const double scale = at_start && at_end ? 0.5 : 1;
  if (at_start) add_extraordinary(h, scale, terms);
  if (at_end) add_extraordinary(twin, scale, terms);
}

// Whether the vertex at the start of a smooth halfedge has a rule of its own.
bool Stencils::uses_ring(Index h) const {
  const Index v = level_.start(h);
  if (level_.sharp_edges[v] == 0) return level_.valences[v] != kRegularValence;
  if (rule_ == BoundaryRule::Reflect || level_.sharp_edges[v] == 1) return false;
  std::size_t triangles = 1;
  for (Index g = level_.across(MeshLevel::previous(h)); g != MeshLevel::kNone; ++triangles) {
    g = level_.across(MeshLevel::previous(g));
  }
  for (Index g = h; level_.across(g) != MeshLevel::kNone; ++triangles) g = MeshLevel::next(level_.across(g));
  return triangles != kRegularSector;
}

// The other end of the second sharp edge at a vertex that has just two; kNone at the end of a crease and at a
// corner.
Index Stencils::sharp_neighbour(Index v, Index except) const {
  if (level_.sharp_edges[v] != 2) return MeshLevel::kNone;
  const Index first = level_.outgoing[v];
  Index h = first;
  do {
    if (level_.is_sharp(h) && level_.end(h) != except) return level_.end(h);
    const Index incoming = MeshLevel::previous(h);
    if (level_.is_sharp(incoming) && level_.start(incoming) != except) return level_.start(incoming);
    h = level_.twins[incoming];
  } while (h != MeshLevel::kNone && h != first);
  return MeshLevel::kNone;
}

// The 4-point rule. Where the curve ends, a neighbour is extrapolated: p0 = 3 p1 - 3 p2 + p3.
void Stencils::add_sharp(Index h, std::vector<Term>& terms) const {
  const Index p1 = level_.start(h), p2 = level_.end(h);
  const Index p0 = sharp_neighbour(p1, p2), p3 = sharp_neighbour(p2, p1);
  if (p0 == MeshLevel::kNone && p3 == MeshLevel::kNone) {
    terms.insert(terms.end(), {{p1, 0.5}, {p2, 0.5}});
  } else if (p0 == MeshLevel::kNone) {
    terms.insert(terms.end(), {{p1, 3.0 / 8}, {p2, 3.0 / 4}, {p3, -1.0 / 8}});
  } else if (p3 == MeshLevel::kNone) {
    terms.insert(terms.end(), {{p2, 3.0 / 8}, {p1, 3.0 / 4}, {p0, -1.0 / 8}});
  } else {
    terms.insert(terms.end(), {{p0, -1.0 / 16}, {p1, 9.0 / 16}, {p2, 9.0 / 16}, {p3, -1.0 / 16}});
  }
}

void Stencils::add_regular(Index h, std::vector<Term>& terms) const {
  const Index twin = level_.twins[h];
  terms.insert(terms.end(), {{level_.start(h), kEnd}, {level_.end(h), kEnd}});
  terms.insert(terms.end(), {{level_.opposite(h), kOpposite}, {level_.opposite(twin), kOpposite}});
  for (const Index side : {h, twin}) {
    add_wing(MeshLevel::next(side), terms);
    add_wing(MeshLevel::previous(side), terms);
  }
}

// The vertex across an edge; where that is sharp the mirror image s + t - o of this side's.
void Stencils::add_wing(Index h, std::vector<Term>& terms) const {
  if (const Index other = level_.across(h); other != MeshLevel::kNone) {
    terms.emplace_back(level_.opposite(other), kWing);
  } else {
    terms.insert(terms.end(),
                 {{level_.start(h), kWing}, {level_.end(h), kWing}, {level_.opposite(h), -kWing}});
  }
}

void Stencils::add_extraordinary(Index h, double scale, std::vector<Term>& terms) const {
  const Index v = level_.start(h);
  if (level_.sharp_edges[v] > 0) return add_trigonometric(h, scale, terms);
  if (is_hub(v)) return;
  terms.emplace_back(v, kCentre * scale);
  for (const double weight : weights_[level_.valences[v]]) {
    terms.emplace_back(level_.end(h), weight * scale);
    h = level_.twins[MeshLevel::previous(h)];
  }
}

// The start vertex of h lies on sharp edges; its ring runs from the sharp edge before h to the one behind it.
void Stencils::add_trigonometric(Index h, double scale, std::vector<Term>& terms) const {
  std::size_t position = 0;
  while (level_.across(h) != MeshLevel::kNone) {
    h = MeshLevel::next(level_.across(h));
    ++position;
  }
  std::vector<Index> ring = {level_.end(h)};
  for (Index g = h; g != MeshLevel::kNone; g = level_.across(MeshLevel::previous(g))) {
    ring.push_back(level_.opposite(g));
  }
  const std::vector<double> weights = trigonometric_weights(ring.size() - 1, position);
  terms.emplace_back(level_.start(h), weights.back() * scale);
  for (std::size_t j = 0; j < ring.size(); ++j) terms.emplace_back(ring[j], weights[j] * scale);
}

}  // namespace detail
}  // namespace meshcontour
