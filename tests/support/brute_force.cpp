#include "support/brute_force.hpp"

#include <algorithm>

namespace brute_force {
namespace {

bool runs(const Triangle& t, Index from, Index to) {
  return (t[0] == from && t[1] == to) || (t[1] == from && t[2] == to) || (t[2] == from && t[0] == to);
}

}  // namespace

Topology::Topology(std::span<const Triangle> triangles) {
  for (const Triangle& t : triangles) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    for (const Index v : t) parents_[{v, triangles_.size()}] = {v, triangles_.size()};
    for (std::size_t k = 0; k < 3; ++k) edges_[key(t[k], t[(k + 1) % 3])].push_back(triangles_.size());
    triangles_.push_back(t);
  }
  for (const auto& [edge, sides] : edges_) {
    if (sides.size() != 2) continue;
    for (const Index v : {edge.first, edge.second}) parents_[fan_of({v, sides[0]})] = fan_of({v, sides[1]});
  }
}

Topology::Corner Topology::fan_of(Corner corner) const {
  while (parents_.at(corner) != corner) corner = parents_.at(corner);
  return corner;
}

std::vector<BoundaryEdge> Topology::boundary() const {
  std::vector<BoundaryEdge> result;
  for (const auto& [edge, sides] : edges_) {
    if (sides.size() != 1) continue;
    const auto [a, b] = edge;
    result.push_back(runs(triangles_[sides[0]], a, b) ? BoundaryEdge{a, b} : BoundaryEdge{b, a});
  }
  std::ranges::sort(result);
  return result;
}

std::size_t Topology::edges_with_more_than_two() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(edges_, [](const auto& e) { return e.second.size() > 2; }));
}

std::size_t Topology::edges_run_twice_the_same_way() const {
  return static_cast<std::size_t>(std::ranges::count_if(edges_, [&](const auto& e) {
    const auto& [edge, sides] = e;
    return sides.size() == 2 && runs(triangles_[sides[0]], edge.first, edge.second) ==
                                    runs(triangles_[sides[1]], edge.first, edge.second);
  }));
}

bool Topology::manifold() const {
  std::map<Index, std::set<Corner>> fans;
  for (const auto& [corner, parent] : parents_) fans[corner.first].insert(fan_of(corner));
  return edges_with_more_than_two() == 0 &&
         std::ranges::all_of(fans, [](const auto& fan) { return fan.second.size() == 1; });
}

bool Topology::orientable() const {
  std::vector<std::optional<bool>> turned(triangles_.size());
  for (std::size_t first = 0; first < turned.size(); ++first) {
    if (turned[first]) continue;
    turned[first] = false;
    std::vector<std::size_t> reached = {first};
    for (std::size_t next = 0; next < reached.size(); ++next) {
      const std::size_t t = reached[next];
      for (std::size_t k = 0; k < 3; ++k) {
        const Index from = triangles_[t][k], to = triangles_[t][(k + 1) % 3];
        const auto& sides = edges_.at(key(from, to));
        if (sides.size() != 2) continue;
        const std::size_t other = sides[0] == t ? sides[1] : sides[0];
        const bool wanted = *turned[t] != runs(triangles_[other], from, to);
        if (turned[other] && *turned[other] != wanted) return false;
        if (!turned[other]) reached.push_back(other);
        turned[other] = wanted;
      }
    }
  }
  return true;
}

int Topology::euler() const {
  std::set<Index> vertices;
  for (const Triangle& t : triangles_) vertices.insert(t.begin(), t.end());
  return static_cast<int>(vertices.size()) - static_cast<int>(edges_.size()) +
         static_cast<int>(triangles_.size());
}

std::size_t Topology::odd_vertices() const {
  std::map<Index, std::size_t> ends;
  for (const auto& [edge, sides] : edges_) {
    if (sides.size() != 1) continue;
    ++ends[edge.first];
    ++ends[edge.second];
  }
  return static_cast<std::size_t>(
      std::ranges::count_if(ends, [](const auto& e) { return e.second % 2 == 1; }));
}

std::set<Topology::Corner> Topology::broken_fans(Index vertex) const {
  std::set<Corner> broken;
  for (const auto& [edge, sides] : edges_) {
    if (sides.size() < 3 || (edge.first != vertex && edge.second != vertex)) continue;
    for (const std::size_t t : sides) broken.insert(fan_of({vertex, t}));
  }
  return broken;
}

bool Topology::may_follow(Index vertex, BoundaryEdge a, BoundaryEdge b) const {
  const Corner fan_a = fan_of({vertex, edges_.at(key(a.from, a.to)).front()});
  const Corner fan_b = fan_of({vertex, edges_.at(key(b.from, b.to)).front()});
  if (fan_a == fan_b) return true;
  const std::set<Corner> broken = broken_fans(vertex);
  return broken.contains(fan_a) && broken.contains(fan_b);
}

}  // namespace brute_force
