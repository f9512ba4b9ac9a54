#include "multires/collapse_mesh.hpp"

#include <algorithm>
#include <array>

#include "model/adjacency.hpp"
#include "multires/patches.hpp"

namespace meshcontour::detail {
CollapseMesh::CollapseMesh(const Shell& shell, unsigned threads) {
  std::vector<bool> fixed(shell.points.size(), false);
  mark_loop_starts(shell, fixed);
  triangle_count_ = shell.triangles.size();
  pair_halfedges(shell, threads, fixed);
  mark_sharp(shell);
  split_fans(shell, fixed);
  find_kinds(fixed);
  marks_.assign(vertex_count(), 0);
}

void CollapseMesh::pair_halfedges(const Shell& shell, unsigned threads, std::vector<bool>& fixed) {
  const auto& triangles = shell.triangles;
  twins_ = side_adjacency(triangles, shell.points.size(), threads).opposite;
  for (Index h = 0; h < twins_.size(); ++h) {
    const Index from = side_start(triangles, h);
    const Triangle& t = triangles[h / 3];
    const bool repeats = t[0] == t[1] || t[1] == t[2] || t[2] == t[0], paired = is_paired(twins_[h]);
    if (repeats || twins_[h] == kManySides || (paired && side_start(triangles, twins_[h]) == from)) {
      for (const Index v : triangles[h / 3]) fixed[v] = true;
      if (paired) twins_[twins_[h]] = kNone;
      twins_[h] = kNone;
    }
    if (!is_paired(twins_[h])) twins_[h] = kNone;
  }
}

void CollapseMesh::mark_sharp(const Shell& shell) {
  const std::vector<std::size_t> patches = patch_of_triangles(shell);
  sharp_.assign(twins_.size(), 0);
  for (Index h = 0; h < twins_.size(); ++h) {
    if (twins_[h] == kNone) continue;
    const auto [low, high] = std::minmax({side_start(shell.triangles, h), side_end(shell.triangles, h)});
    const bool crease = std::ranges::binary_search(shell.creases, std::array<Index, 2>{low, high});
    sharp_[h] = patches[h / 3] != patches[twins_[h] / 3] ? 1 : crease ? 2 : 0;
  }
}

void CollapseMesh::split_fans(const Shell& shell, std::vector<bool>& fixed) {
  corners_.assign(twins_.size(), kNone);
  std::vector<bool> seen(shell.points.size(), false);
  for (Index first = 0; first < twins_.size(); ++first) {
    if (corners_[first] != kNone) continue;
    const Index point = side_start(shell.triangles, first), v = static_cast<Index>(origin_.size());
    if (seen[point]) fixed[point] = true;
    seen[point] = true;
    origin_.push_back(point);
    points_.push_back(shell.points[point]);
    Index h = first;
    while (twins_[h] != kNone && next(twins_[h]) != first) h = next(twins_[h]);  // back to the border
    leaving_.push_back(h);
    while (h != kNone && corners_[h] == kNone) {
      corners_[h] = v;
      h = twins_[previous(h)];
    }
  }
}

void CollapseMesh::find_kinds(const std::vector<bool>& fixed) {
  std::vector<std::uint8_t> sharp_edges(vertex_count(), 0);
  on_border_.assign(vertex_count(), false);
  valences_.assign(vertex_count(), 0);
  for (Index h = 0; h < twins_.size(); ++h) {
    if (twins_[h] != kNone && twins_[h] < h) continue;
    for (const Index v : {start(h), end(h)}) {
      ++valences_[v];
      if (is_sharp(h) && sharp_edges[v] < 3) ++sharp_edges[v];
      if (twins_[h] == kNone) on_border_[v] = true;
    }
  }
  kinds_.resize(vertex_count());
  for (Index v = 0; v < vertex_count(); ++v) {
    const bool stays = fixed[origin_[v]] || (sharp_edges[v] != 0 && sharp_edges[v] != 2);
    kinds_[v] = stays ? Kind::Fixed : sharp_edges[v] == 2 ? Kind::Curve : Kind::Smooth;
  }
}

void CollapseMesh::outgoing(Index v, std::vector<Index>& halfedges) const {
  halfedges.clear();
  Index first = leaving_[v];
  for (Index h = first; twins_[h] != kNone;) {
    h = next(twins_[h]);
    if (h == leaving_[v]) break;
    first = h;
  }
  // Round an inner vertex the walk back ended one step short of where it began.
  Index h = first;
  do {
    halfedges.push_back(h);
    h = twins_[previous(h)];
  } while (h != kNone && h != first);
}

std::size_t CollapseMesh::common_neighbours(Index u, Index v) {
  ++mark_;
  const auto for_ring = [&](Index w, auto&& visit) {
    outgoing(w, ring_);
    for (const Index h : ring_) visit(end(h));
    // The last neighbour of a border vertex has no halfedge that leads to it.
    if (twins_[previous(ring_.back())] == kNone) visit(start(previous(ring_.back())));
  };
  for_ring(u, [&](Index w) { marks_[w] = mark_; });
  std::size_t common = 0;
  for_ring(v, [&](Index w) { common += marks_[w] == mark_; });
  return common;
}

bool CollapseMesh::keeps_topology(Index h) {
  const Index u = start(h), v = end(h);
  if (kinds_[u] != Kind::Smooth && kinds_[v] != Kind::Smooth && !is_sharp(h)) return false;
  if (kinds_[u] == Kind::Fixed && kinds_[v] == Kind::Fixed) return false;
  std::size_t triangles = 0;
  for (const Index side : {h, twins_[h]}) {
    if (side == kNone) continue;
    ++triangles;
    const Index a = next(side), b = previous(side);
    if (twins_[a] == kNone && twins_[b] == kNone) return false;
    if (is_sharp(a) && is_sharp(b)) return false;  // a curve would close on itself
    const Index apex = start(b);
    if (side != h && apex == start(previous(h))) return false;
    if (valences_[apex] < (on_border_[apex] ? 3 : 4)) return false;  // it loses an edge
  }
  const std::size_t merged = valences_[u] + valences_[v] - 2 - triangles;
  if (merged < (on_border_[u] || on_border_[v] ? 2 : 3)) return false;
  return common_neighbours(u, v) == triangles;
}

// The two outer neighbours of a dying triangle become neighbours of each other.
void CollapseMesh::join(Index h, Index kept) {
  const Index a = next(h), b = previous(h), outer_a = twins_[a], outer_b = twins_[b], apex = start(b);
  const std::uint8_t sharp = std::max(sharp_[a], sharp_[b]);
  for (const auto& [outer, other] : {std::pair{outer_a, outer_b}, std::pair{outer_b, outer_a}}) {
    if (outer == kNone) continue;
    twins_[outer] = other;
    sharp_[outer] = sharp;
  }
  // outer_a runs from the apex, outer_b to it.
  leaving_[apex] = outer_a != kNone ? outer_a : next(outer_b);
  leaving_[kept] = outer_b != kNone ? outer_b : next(outer_a);
  for (const Index dead : {h, a, b}) corners_[dead] = kNone;
  --valences_[apex];
  --triangle_count_;
}

void CollapseMesh::collapse(Index h, Index removed, const Point& position) {
  const Index kept = start(h) == removed ? end(h) : start(h);
  outgoing(removed, ring_);
  for (const Index g : ring_) corners_[g] = kept;
  const Index twin = twins_[h];
  valences_[kept] += valences_[removed] - (twin == kNone ? 3 : 4);
  on_border_[kept] = on_border_[kept] || on_border_[removed];
  // Both ends are `kept` by now; what join reads are the apex and the outer halfedges.
  join(h, kept);
  if (twin != kNone) join(twin, kept);
  points_[kept] = position;
}

bool CollapseMesh::can_flip(Index h) {
  if (is_sharp(h)) return false;
  for (const Index v : {start(h), end(h)}) {
    if (valences_[v] < (on_border_[v] ? 3 : 4)) return false;  // it loses an edge
  }
  const Index tip = start(previous(h)), across = start(previous(twins_[h]));
  if (tip == across) return false;
  // The one with fewer edges is gone round.
  const auto [least, other] =
      valences_[tip] <= valences_[across] ? std::pair(tip, across) : std::pair(across, tip);
  outgoing(least, ring_);
  return std::ranges::none_of(
      ring_, [&, other = other](Index g) { return end(g) == other || start(previous(g)) == other; });
}

void CollapseMesh::flip(Index h) {
  const Index g = twins_[h], u = start(h), v = end(h), tip = start(previous(h)), across = start(previous(g));
  --valences_[u];
  --valences_[v];
  ++valences_[tip];
  ++valences_[across];
  // What lay between v and the tip, u and the tip across, and that and v goes to other halfedges.
  const std::array<std::pair<Index, Index>, 3> moves = {{{next(h), next(g)}, {next(g), h}, {previous(g), g}}};
  std::array<Index, 3> twins{};
  std::array<std::uint8_t, 3> sharp{};
  for (std::size_t i = 0; i < 3; ++i) {
    twins[i] = twins_[moves[i].first];
    sharp[i] = sharp_[moves[i].first];
  }
  corners_[h] = u;
  corners_[next(h)] = corners_[g] = across;
  corners_[previous(h)] = corners_[previous(g)] = tip;
  corners_[next(g)] = v;
  for (std::size_t i = 0; i < 3; ++i) {
    twins_[moves[i].second] = twins[i];
    sharp_[moves[i].second] = sharp[i];
    if (twins[i] != kNone) twins_[twins[i]] = moves[i].second;
  }
  twins_[next(h)] = previous(g);
  twins_[previous(g)] = next(h);
  sharp_[next(h)] = sharp_[previous(g)] = 0;
  leaving_[u] = h;
  leaving_[v] = next(g);
  leaving_[tip] = previous(h);
  leaving_[across] = g;
}

// A vertex that is left, by its point; the fans around one point share its place.
std::vector<Index> CollapseMesh::vertices_by_origin(std::size_t points) const {
  std::vector<Index> vertices(points, kNone);
  for (const Index v : corners_) {
    if (v != kNone) vertices[origin_[v]] = v;
  }
  return vertices;
}

Shell CollapseMesh::to_shell(const Shell& before) const {
  Shell shell;
  shell.id = before.id;
  shell.color = before.color;
  std::vector<Index> number = vertices_by_origin(before.points.size());
  for (Index& vertex : number) {
    if (vertex == kNone) continue;
    shell.points.push_back(points_[vertex]);
    vertex = static_cast<Index>(shell.points.size() - 1);
  }
  for (const Patch& patch : before.patches) {
    Patch& kept = shell.patches.emplace_back(patch);
    kept.first_triangle = shell.triangles.size();
    for (std::size_t t = patch.first_triangle; t < patch.first_triangle + patch.triangle_count; ++t) {
      if (corners_[3 * t] == kNone) continue;
      Triangle& triangle = shell.triangles.emplace_back();
      bool same = true;
      for (std::size_t k = 0; k < 3; ++k) {
        const Index v = corners_[3 * t + k];
        triangle[k] = number[origin_[v]];
        same = same && origin_[v] == before.triangles[t][k] && points_[v] == before.points[origin_[v]];
      }
      for (std::size_t k = 0; k < 3 && !before.corner_normals.empty(); ++k) {
        shell.corner_normals.push_back(same ? before.corner_normals[3 * t + k] : Vector::Zero());
      }
    }
    kept.triangle_count = shell.triangles.size() - kept.first_triangle;
  }
  add_creases(number, shell);
  return shell;
}

void CollapseMesh::add_creases(const std::vector<Index>& number, Shell& shell) const {
  for (Index h = 0; h < corners_.size(); ++h) {
    if (corners_[h] == kNone || twins_[h] == kNone || twins_[h] < h || sharp_[h] != 2) continue;
    const auto [low, high] = std::minmax(number[origin_[start(h)]], number[origin_[end(h)]]);
    shell.creases.push_back({low, high});
  }
  std::ranges::sort(shell.creases);
}

}  // namespace meshcontour::detail
