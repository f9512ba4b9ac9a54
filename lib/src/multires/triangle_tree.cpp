#include "multires/triangle_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace meshcontour::detail {
namespace {

constexpr Index kLeafSize = 4;
constexpr double kRounding = 1e-14;      // of a coordinate
constexpr double kLong = 16;             // triangles: the squares of their long sides beside doubled areas
constexpr double kAligned = 0.9;         // triangles: the sum of their long sides beside that of the lengths
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

// All but the shortest one.
std::array<Vector, 2> long_sides(const Corners& t) {
  std::array<Vector, 3> sides = {t[1] - t[0], t[2] - t[1], t[0] - t[2]};
  std::ranges::sort(sides, std::ranges::greater{}, [](const Vector& side) { return side.squaredNorm(); });
  return {sides[0], sides[1]};
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

// How triangles lie, on the whole.
struct TriangleTree::Directions {
  Vector normal = Vector::Zero(), along = Vector::Zero();
  double aspect = 1;     // of the triangles: length beside width
  bool aligned = false;  // whether they are long, in about the same direction
};

TriangleTree::Directions TriangleTree::directions_of(std::span<const Index> triangles) const {
  Directions out;
  double areas = 0, lengths = 0, squares = 0;
  for (const Index t : triangles) {
    const auto& [a, b, c] = corners_[t];
    const Vector cross = (b - a).cross(c - a), side = longest_side(corners_[t]);
    add_aligned(out.normal, cross);
    add_aligned(out.along, side);
    areas += cross.norm();
    squares += side.squaredNorm();
    lengths += side.norm();
  }
  out.aspect = squares / areas;
  out.aligned = squares > kLong * areas && out.along.norm() > kAligned * lengths;
  out.normal.stableNormalize();
  out.along.stableNormalize();
  return out;
}

TriangleTree::Slab TriangleTree::slab_of(const Vector& across, std::span<const Index> triangles) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Slab slab{across, kInfinity, -kInfinity};
  double size = 0;
  for (const Index t : triangles) {
    for (const Point& corner : corners_[t]) {
      const double at = across.dot(corner);
      slab.low = std::min(slab.low, at);
      slab.high = std::max(slab.high, at);
      size = std::max(size, corner.cwiseAbs().maxCoeff());
    }
  }
  slab.low -= kRounding * size;
  slab.high += kRounding * size;
  return slab;
}

// Along the long sides that lie most to the right and most to the left of their mean.
TriangleTree::Sector TriangleTree::sector_of(const Directions& directions,
                                             std::span<const Index> triangles) const {
  const auto& [normal, along, aspect, aligned] = directions;
  Vector right = along, left = along;
  for (const Index t : triangles) {
    for (Vector side : long_sides(corners_[t])) {
      if (side.dot(along) < 0) side = -side;
      if (normal.dot(right.cross(side)) < 0) right = side;
      if (normal.dot(left.cross(side)) > 0) left = side;
    }
  }
  return {slab_of(normal.cross(right).stableNormalized(), triangles),
          slab_of(normal.cross(left).stableNormalized(), triangles), slab_of(normal, triangles)};
}

void TriangleTree::bound(Node& node, const Directions& directions, std::span<const Index> triangles) {
  for (const Index t : triangles) {
    for (const Point& corner : corners_[t]) node.box.extend(corner);
  }
  node.slab = slab_of(directions.normal.cross(directions.along).stableNormalized(), triangles);
  if (!directions.aligned) return;
  node.sector = static_cast<Index>(sectors_.size());
  sectors_.push_back(sector_of(directions, triangles));
}

double TriangleTree::squared_distance(const Node& node, const Point& p) const {
  double beyond = node.slab.distance(p);
  if (node.sector != kNoSector) {
    for (const Slab& slab : sectors_[node.sector]) beyond = std::max(beyond, slab.distance(p));
  }
  return std::max(node.box.squaredExteriorDistance(p), beyond * beyond);
}

// The direction in which to halve a set of triangles: the side of the box of their centres that is longest;
// of long ones along them or across, in which the centres are farther apart beside the extents of the
// triangles.
Vector TriangleTree::cut_direction(const Directions& directions, std::span<const Index> triangles,
                                   const std::vector<Point>& centres) const {
  if (directions.aligned) {
    const Vector across = directions.normal.cross(directions.along);
    const auto extent = [&](const Vector& direction) {
      double low = direction.dot(centres[triangles.front()]), high = low;
      for (const Index t : triangles) {
        const double at = direction.dot(centres[t]);
        low = std::min(low, at);
        high = std::max(high, at);
      }
      return high - low;
    };
    return directions.aspect * extent(across) > extent(directions.along) ? across : directions.along;
  }
  Box spread;
  for (const Index t : triangles) spread.extend(centres[t]);
  Eigen::Index axis = 0;
  spread.sizes().maxCoeff(&axis);
  return Vector::Unit(axis);
}

void TriangleTree::build() {
  struct Task {
    Index first, count, parent;
  };
  std::vector<Task> tasks = {{0, static_cast<Index>(number_.size()), 0}};
  std::vector<Point> centres(corners_.size());
  std::vector<double> places(corners_.size());  // of the centres, in the direction of a cut
  for (std::size_t t = 0; t < centres.size(); ++t)
    centres[t] = (corners_[t][0] + corners_[t][1] + corners_[t][2]) / 3;
  // The last task pushed is a node's first child, so that it follows the node.
  while (!tasks.empty()) {
    const auto [first, count, parent] = tasks.back();
    tasks.pop_back();
    const auto index = static_cast<Index>(nodes_.size());
    if (index > 0 && index != parent + 1) nodes_[parent].second = index;
    Node& node = nodes_.emplace_back();
    const std::span<const Index> triangles(number_.data() + first, count);
    const Directions directions = directions_of(triangles);
    bound(node, directions, triangles);
    if (count <= kLeafSize) {
      node.first = first;
      node.count = count;
      continue;
    }
    const Vector direction = cut_direction(directions, triangles, centres);
    for (const Index t : triangles) places[t] = direction.dot(centres[t]);
    const auto begin = number_.begin() + first;
    std::nth_element(begin, begin + count / 2, begin + count, [&](Index a, Index b) {
      return places[a] < places[b] || (places[a] == places[b] && a < b);
    });
    tasks.push_back({first + count / 2, count - count / 2, index});
    tasks.push_back({first, count / 2, index});
  }
}

void TriangleTree::look_at(const Node& leaf, const Point& p, Hit& best) const {
  for (Index i = leaf.first; i < leaf.first + leaf.count; ++i) {
    const double squared = (nearest_point(corners_[i], p) - p).squaredNorm();
    if (!(squared < best.squared)) continue;
    best.squared = squared;
    best.triangle = number_[i];
  }
  best.looked_at += leaf.count;
}

TriangleTree::Hit TriangleTree::nearest(const Point& p, Index hint) const {
  Hit best;
  if (nodes_.empty()) return best;
  // The hint is found again where it is what the search would meet.
  const double at_hint = (nearest_point(corners(hint), p) - p).squaredNorm();
  if (at_hint < best.squared) best.squared = std::nextafter(at_hint, best.squared);
  std::array<std::pair<Index, double>, kStackSize> stack;
  std::size_t size = 0;
  stack[size++] = {0, 0};
  while (size > 0) {
    const auto [index, bound] = stack[--size];
    if (bound >= best.squared) continue;
    const Node& node = nodes_[index];
    if (node.count > 0) {
      look_at(node, p, best);
      continue;
    }
    std::pair<Index, double> near{index + 1, squared_distance(nodes_[index + 1], p)};
    std::pair<Index, double> far{node.second, squared_distance(nodes_[node.second], p)};
    if (far.second < near.second) std::swap(near, far);
    stack[size++] = far;
    stack[size++] = near;
  }
  return best;
}

}  // namespace meshcontour::detail
