#include "multires/adaptive.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "multires/triangle_shape.hpp"

namespace meshcontour::detail {
namespace {

constexpr double kTangentialShare = 0.1;  // of an error that moves along the surface
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<Vector> vertex_normals(const MeshLevel& level, std::span<const Point> points) {
  std::vector<Vector> normals(level.vertex_count, Vector::Zero());
  for (const auto& [a, b, c] : level.triangles) {
    const Vector cross = (points[b] - points[a]).cross(points[c] - points[a]);
    for (const Index v : {a, b, c}) normals[v] += cross;
  }
  for (Vector& normal : normals) normal.stableNormalize();
  return normals;
}

}  // namespace

// A triangle of the adaptive mesh with the active midpoints of its sides, at most two; turned so that these
// lie on the sides 0-1 and 1-2.
struct AdaptiveMesh::Leaf {
  std::array<Index, 3> corners{};
  std::array<Index, 2> middles{};
  std::size_t active = 0;
  std::size_t turn = 0;  // the triangle's corner that comes first
  bool from_first =
      false;  // the diagonal of the rest runs from corner 0 to middle 1, else from middle 0 to corner 2

  void triangles(std::vector<Triangle>& out) const {
    const auto [a, b, c] = corners;
    const auto [m, n] = middles;
    if (active == 0) out.push_back({a, b, c});
    if (active == 1) out.insert(out.end(), {{a, m, c}, {m, b, c}});
    if (active < 2) return;
    out.push_back({m, b, n});
    if (from_first) {
      out.insert(out.end(), {{a, m, n}, {a, n, c}});
    } else {
      out.insert(out.end(), {{a, m, c}, {m, n, c}});
    }
  }
};

AdaptiveMesh::AdaptiveMesh(const SubdivisionConnectivity& connectivity, std::span<const Point> points,
                           const std::vector<bool>& kept, EdgeMeasure measure)
    : points_(points.begin(), points.end()) {
  levels_.push_back(make_level(connectivity.base));
  for (unsigned j = 0; j < connectivity.levels; ++j) levels_.push_back(quadrisected(levels_.back()));
  this->measure(kept, measure);
  saturate();
}

void AdaptiveMesh::measure(const std::vector<bool>& kept, EdgeMeasure measure) {
  const std::vector<Vector> normals = vertex_normals(levels_.back(), points_);
  errors_.resize(levels_.size() - 1);
  for (std::size_t j = 0; j < errors_.size(); ++j) {
    const MeshLevel& level = levels_[j];
    errors_[j].resize(level.edge_count());
    for (Index e = 0; e < level.edge_count(); ++e) {
      const Index h = level.first_halfedge[e], m = level.vertex_count + e;
      const Point &a = points_[level.start(h)], &b = points_[level.end(h)];
      const Vector shift = points_[m] - (a + b) / 2;
      const double scale = measure == EdgeMeasure::Integral ? (b - a).norm() : 1;
      const double along_normal = shift.dot(normals[m]);
      const double within = (shift - along_normal * normals[m]).norm();
      errors_[j][e] = kept[m]          ? kInfinity
                      : level.sharp[e] ? scale * shift.norm()
                                       : scale * std::hypot(along_normal, kTangentialShare * within);
    }
  }
}

// Calls visit(edge) for the edges of level j - 1 that an active edge of level j needs.
template <class Visit>
void AdaptiveMesh::for_each_parent(std::size_t j, Index edge, Visit&& visit) const {
  const Index h = levels_[j].first_halfedge[edge];
  for (const Index side : {h, levels_[j].twins[h]}) {
    if (side == MeshLevel::kNone) continue;
    const Index parent = side / 12;  // four triangles of three sides
    for (Index k = 0; k < 3; ++k) visit(levels_[j - 1].edges[3 * parent + k]);
  }
}

void AdaptiveMesh::saturate() {
  for (std::size_t j = errors_.size(); j-- > 1;) {
    for (Index e = 0; e < errors_[j].size(); ++e) {
      for_each_parent(j, e, [&](Index parent) {
        errors_[j - 1][parent] = std::max(errors_[j - 1][parent], errors_[j][e]);
      });
    }
  }
}

void AdaptiveMesh::close(ActiveEdges& active) const {
  for (std::size_t j = active.size(); j-- > 1;) {
    for (Index e = 0; e < active[j].size(); ++e) {
      if (active[j][e]) for_each_parent(j, e, [&](Index parent) { active[j - 1][parent] = true; });
    }
  }
}

AdaptiveMesh::ActiveEdges AdaptiveMesh::edges_above(double error) const {
  ActiveEdges active(errors_.size());
  for (std::size_t j = 0; j < errors_.size(); ++j) {
    active[j].resize(errors_[j].size());
    for (std::size_t e = 0; e < errors_[j].size(); ++e) active[j][e] = errors_[j][e] >= error;
  }
  return active;
}

double AdaptiveMesh::error_for(std::size_t triangles) const {
  // Each active edge cuts the triangles beside it in two, once.
  std::vector<std::pair<double, std::size_t>> cuts;
  for (std::size_t j = 0; j < errors_.size(); ++j) {
    for (Index e = 0; e < errors_[j].size(); ++e) {
      const bool border = levels_[j].twins[levels_[j].first_halfedge[e]] == MeshLevel::kNone;
      cuts.emplace_back(errors_[j][e], border ? 1 : 2);
    }
  }
  std::ranges::sort(cuts, std::greater{});
  std::size_t count = levels_[0].triangles.size();
  double reached = kInfinity;
  for (std::size_t i = 0; i < cuts.size();) {
    std::size_t next = i;
    for (; next < cuts.size() && cuts[next].first == cuts[i].first; ++next) count += cuts[next].second;
    if (count > triangles) break;
    reached = cuts[i].first;
    i = next;
  }
  return reached;
}

AdaptiveMesh::Leaf AdaptiveMesh::leaf_of(const ActiveEdges& active, std::size_t j, Index face) const {
  const MeshLevel& level = levels_[j];
  const auto wanted = [&](std::size_t k) {
    return j < active.size() && active[j][level.edges[3 * face + k % 3]];
  };
  Leaf leaf;
  for (std::size_t k = 0; k < 3; ++k) leaf.active += wanted(k);
  if (leaf.active == 3) return leaf;
  while (leaf.active > 0 && !(wanted(leaf.turn) && !wanted(leaf.turn + 2))) ++leaf.turn;
  for (std::size_t k = 0; k < 3; ++k) leaf.corners[k] = level.triangles[face][(leaf.turn + k) % 3];
  for (std::size_t k = 0; k < leaf.active; ++k) {
    leaf.middles[k] = level.vertex_count + level.edges[3 * face + (leaf.turn + k) % 3];
  }
  if (leaf.active == 2) {
    const Point &a = points_[leaf.corners[0]], &c = points_[leaf.corners[2]], &m = points_[leaf.middles[0]],
                &n = points_[leaf.middles[1]];
    leaf.from_first = std::max(cosine_of_smallest_angle(a, m, n), cosine_of_smallest_angle(a, n, c)) <
                      std::max(cosine_of_smallest_angle(a, m, c), cosine_of_smallest_angle(m, n, c));
  }
  return leaf;
}

// Calls visit(leaf, level, face) for the triangles of the set, base triangle by base triangle.
template <class Visit>
void AdaptiveMesh::for_each_leaf(const ActiveEdges& active, Visit&& visit) const {
  std::vector<std::pair<std::size_t, Index>> stack;
  for (Index base = 0; base < levels_[0].triangles.size(); ++base) {
    stack.emplace_back(0, base);
    while (!stack.empty()) {
      const auto [j, face] = stack.back();
      stack.pop_back();
      const Leaf leaf = leaf_of(active, j, face);
      if (leaf.active < 3) {
        visit(leaf, j, face, base);
        continue;
      }
      for (Index child = 4; child-- > 0;) stack.emplace_back(j + 1, 4 * face + child);
    }
  }
}

std::vector<Triangle> AdaptiveMesh::triangles(const ActiveEdges& active,
                                              std::vector<std::size_t>& first) const {
  std::vector<Triangle> out;
  first.assign(levels_[0].triangles.size() + 1, 0);
  for_each_leaf(active, [&](const Leaf& leaf, std::size_t, Index, Index base) {
    leaf.triangles(out);
    first[base + 1] = out.size();
  });
  return out;
}

}  // namespace meshcontour::detail
