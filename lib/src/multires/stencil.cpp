#include "multires/stencil.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "multires/trigonometric_rule.hpp"

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

constexpr std::uint32_t kRegularSector = 3;  // triangles at a regular vertex of a straight border

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
  if (rule == BoundaryRule::Trigonometric) find_sectors();
}

void Stencils::find_sectors() {
  sectors_.assign(level_.twins.size(), 0);
  for (Index first = 0; first < sectors_.size(); ++first) {
    if (level_.across(first) != MeshLevel::kNone || level_.sharp_edges[level_.start(first)] < 2) continue;
    std::uint32_t triangles = 0;
    for (Index h = first; h != MeshLevel::kNone; h = level_.across(MeshLevel::previous(h))) ++triangles;
    for (Index h = first; h != MeshLevel::kNone; h = level_.across(MeshLevel::previous(h)))
      sectors_[h] = triangles;
    if (triangles > kLargestRing) fans_.push_back(first);
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

Stencils::Fan Stencils::fan(Index first) const {
  Fan out{level_.start(first), level_.end(first), level_.end(first), {}};
  for (Index h = first; h != MeshLevel::kNone; h = level_.across(MeshLevel::previous(h))) {
    out.last = level_.opposite(h);
    if (h == first) continue;
    const double scale = uses_ring(level_.twins[h]) ? 0.5 : 1;
    out.spokes.push_back({level_.vertex_count + level_.edges[h], level_.end(h), scale});
  }
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
  return rule_ == BoundaryRule::Trigonometric && level_.sharp_edges[v] > 1 && sectors_[h] != kRegularSector;
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
  const std::size_t count = sectors_[h];
  if (count > kLargestRing) return;
  std::size_t place = 0;
  for (; level_.across(h) != MeshLevel::kNone; ++place) h = MeshLevel::next(level_.across(h));
  const TrigonometricRule rule(count);
  terms.emplace_back(level_.start(h), rule.centre(place) * scale);
  terms.emplace_back(level_.end(h), rule.end(place) * scale);
  for (std::size_t j = 1; j < count; ++j) {
    terms.emplace_back(level_.opposite(h), rule.inner(place, j) * scale);
    h = level_.across(MeshLevel::previous(h));
  }
  terms.emplace_back(level_.opposite(h), -rule.end(place) * scale);
}

}  // namespace detail
}  // namespace meshcontour
