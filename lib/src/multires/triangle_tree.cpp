#include "multires/triangle_tree.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace meshcontour::detail {
namespace {

constexpr Index kLeafSize = 4;
constexpr double kRounding = 1e-14;      // of a coordinate
constexpr std::size_t kStackSize = 128;  // twice the depth of a tree that is halved at each node

Point nearest_on_segment(const Point& a, const Point& b, const Point& p) {
  const Vector d = b - a;
  const double length = d.squaredNorm();
  return length > 0 ? Point(a + std::clamp(d.dot(p - a) / length, 0.0, 1.0) * d) : a;
}

Point nearest_on_sides(const Corners& t, const Point& p) {
  Point best = nearest_on_segment(t[0], t[1], p);
  for (const std::size_t k : {1u, 2u}) {
    const Point q = nearest_on_segment(t[k], t[(k + 1) % 3], p);
    if ((q - p).squaredNorm() < (best - p).squaredNorm()) best = q;
  }
  return best;
}

// Adds one of two opposite vectors, whichever makes the sum longer.
void add_aligned(Vector& sum, const Vector& v) {
  if (sum.dot(v) < 0) {
    sum -= v;
  } else {
    sum += v;
  }
}

Vector longest_side(const Corners& t) {
  Vector longest = t[1] - t[0];
  for (const Vector& side : {Vector(t[2] - t[1]), Vector(t[0] - t[2])}) {
    if (side.squaredNorm() > longest.squaredNorm()) longest = side;
  }
  return longest;
}

}  // namespace

Point nearest_point(const Corners& triangle, const Point& p) {
  const auto& [a, b, c] = triangle;
  const Vector ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const Vector bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const Vector cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  const double sum = va + vb + vc;
  if (va > 0 && vb > 0 && vc > 0 && sum > 0) return a + vb / sum * ab + vc / sum * ac;
  return nearest_on_sides(triangle, p);
}

TriangleTree::TriangleTree(std::span<const Point> points, std::span<const Triangle> triangles)
    : corners_(triangles.size()), number_(triangles.size()), place_(triangles.size()) {
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) corners_[t][k] = points[triangles[t][k]];
  }
  std::iota(number_.begin(), number_.end(), Index{0});
  if (!triangles.empty()) build();
  std::vector<Corners> ordered(corners_.size());
  for (std::size_t i = 0; i < number_.size(); ++i) {
    ordered[i] = corners_[number_[i]];
    place_[number_[i]] = static_cast<Index>(i);
  }
  corners_ = std::move(ordered);
}

void TriangleTree::bound(Node& node, std::span<const Index> triangles) const {
  Vector normal = Vector::Zero(), along = Vector::Zero();
  for (const Index t : triangles) {
    const auto& [a, b, c] = corners_[t];
    for (const Point& corner : corners_[t]) node.box.extend(corner);
    add_aligned(normal, (b - a).cross(c - a));
    add_aligned(along, longest_side(corners_[t]));
  }
  node.across = normal.stableNormalized().cross(along.stableNormalized()).stableNormalized();
  node.low = std::numeric_limits<double>::infinity();
  node.high = -node.low;
  double size = 0;
  for (const Index t : triangles) {
    for (const Point& corner : corners_[t]) {
      const double at = node.across.dot(corner);
      node.low = std::min(node.low, at);
      node.high = std::max(node.high, at);
      size = std::max(size, corner.cwiseAbs().maxCoeff());
    }
  }
  node.low -= kRounding * size;
  node.high += kRounding * size;
}

double TriangleTree::squared_distance(const Node& node, const Point& p) {
  const double at = node.across.dot(p), beyond = std::max({node.low - at, at - node.high, 0.0});
  return std::max(node.box.squaredExteriorDistance(p), beyond * beyond);
}

void TriangleTree::build() {
  struct Task {
    Index first, count, parent;
  };
  std::vector<Task> tasks = {{0, static_cast<Index>(number_.size()), 0}};
  std::vector<Point> centres(corners_.size());
  for (std::size_t t = 0; t < centres.size(); ++t)
    centres[t] = (corners_[t][0] + corners_[t][1] + corners_[t][2]) / 3;
  // The last task pushed is a node's first child, so that it follows the node.
  while (!tasks.empty()) {
    const auto [first, count, parent] = tasks.back();
    tasks.pop_back();
    const auto index = static_cast<Index>(nodes_.size());
    if (index > 0 && index != parent + 1) nodes_[parent].second = index;
    Node& node = nodes_.emplace_back();
    Box spread;
    const std::span<const Index> triangles(number_.data() + first, count);
    bound(node, triangles);
    for (const Index t : triangles) spread.extend(centres[t]);
    if (count <= kLeafSize) {
      node.first = first;
      node.count = count;
      continue;
    }
    Eigen::Index axis = 0;
    spread.sizes().maxCoeff(&axis);
    const auto begin = number_.begin() + first;
    std::nth_element(begin, begin + count / 2, begin + count, [&](Index a, Index b) {
      return centres[a][axis] < centres[b][axis] || (centres[a][axis] == centres[b][axis] && a < b);
    });
    tasks.push_back({first + count / 2, count - count / 2, index});
    tasks.push_back({first, count / 2, index});
  }
}

TriangleTree::Hit TriangleTree::nearest(const Point& p) const {
  Hit best;
  if (nodes_.empty()) return best;
  std::array<std::pair<Index, double>, kStackSize> stack;
  std::size_t size = 0;
  stack[size++] = {0, 0};
  while (size > 0) {
    const auto [index, bound] = stack[--size];
    if (bound >= best.squared) continue;
    const Node& node = nodes_[index];
    for (Index i = node.first; i < node.first + node.count; ++i) {
      const double squared = (nearest_point(corners_[i], p) - p).squaredNorm();
      if (squared < best.squared) best = {squared, number_[i]};
    }
    if (node.count > 0) continue;
    std::pair<Index, double> near{index + 1, squared_distance(nodes_[index + 1], p)};
    std::pair<Index, double> far{node.second, squared_distance(nodes_[node.second], p)};
    if (far.second < near.second) std::swap(near, far);
    stack[size++] = far;
    stack[size++] = near;
  }
  return best;
}

}  // namespace meshcontour::detail
