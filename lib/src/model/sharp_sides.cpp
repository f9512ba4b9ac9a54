#include "model/sharp_sides.hpp"

#include <algorithm>
#include <cmath>

#include "meshcontour/parallel.hpp"

namespace meshcontour::detail {
namespace {

constexpr std::size_t kTrianglesAtATime = 1 << 15;

// A triangle lower than this part of the model's size has no direction that could be relied on:
// single-precision coordinates move its corners by about as much.
constexpr double kThinnestReliable = 1e-6;

// Directions of triangles. Lengths are scaled by a power of two, so that no product overflows or vanishes.
class TriangleNormals {
 public:
  TriangleNormals(const Shell& shell, const Adjacency& adjacency, unsigned threads) : shell_(shell) {
    const Box box = bounding_box(shell);
    const double size = box.isEmpty() ? 0 : (box.max() / 2 - box.min() / 2).norm() * 2;
    if (size > 0) scale_ = std::exp2(-std::ilogb(size));
    thinnest_ = kThinnestReliable * size * scale_;
    find_thin(threads);
    find_stand_ins(adjacency);
  }

  // Not of length 1; zero where the triangle and those that could stand in for it have no area.
  Vector operator()(Index triangle) const { return area_vector(source_[triangle]); }

 private:
  Vector edge(Index side) const {
    const Point& from = shell_.points[side_start(shell_.triangles, side)];
    const Point& to = shell_.points[side_end(shell_.triangles, side)];
    return scale_ * to - scale_ * from;
  }

  Vector area_vector(Index triangle) const { return edge(3 * triangle).cross(edge(3 * triangle + 1)); }

  Index longest_side(Index triangle) const {
    Index longest = 3 * triangle;
    for (Index side = longest + 1; side < 3 * triangle + 3; ++side) {
      if (edge(side).squaredNorm() > edge(longest).squaredNorm()) longest = side;
    }
    return longest;
  }

  void find_thin(unsigned threads);
  void find_stand_ins(const Adjacency& adjacency);

  const Shell& shell_;
  double scale_ = 1;
  double thinnest_ = 0;
  std::vector<Index> source_;  // one a triangle: the triangle whose direction is taken
};

// kNoSide stands for "not known yet" until find_stand_ins is done.
void TriangleNormals::find_thin(unsigned threads) {
  source_.resize(shell_.triangles.size());
  parallel_for(source_.size(), kTrianglesAtATime, threads, [&](std::size_t begin, std::size_t end) {
    for (auto t = static_cast<Index>(begin); t < end; ++t) {
      const double longest = edge(longest_side(t)).norm();
      source_[t] = area_vector(t).norm() <= thinnest_ * longest ? kNoSide : t;
    }
  });
}

// Walks over thin triangles across their longest sides until one is reached that has a direction. Each is
// walked once; a walk that ends at a border or bites its own tail leaves the triangles their own directions.
void TriangleNormals::find_stand_ins(const Adjacency& adjacency) {
  constexpr Index kOnTheWay = kManySides;
  std::vector<Index> walk;
  for (Index first = 0; first < source_.size(); ++first) {
    Index t = first;
    for (walk.clear(); source_[t] == kNoSide;) {
      source_[t] = kOnTheWay;
      walk.push_back(t);
      const Index across = adjacency.opposite[longest_side(t)];
      if (is_paired(across)) t = triangle_of(across);
    }
    for (const Index on_the_way : walk)
      source_[on_the_way] = source_[t] == kOnTheWay ? on_the_way : source_[t];
  }
}

}  // namespace

std::vector<std::uint8_t> smooth_sides(const Shell& shell, const Adjacency& adjacency, double radians,
                                       unsigned threads) {
  const TriangleNormals normals(shell, adjacency, threads);
  const double cosine = std::cos(radians);
  std::vector<std::uint8_t> smooth(adjacency.opposite.size(), 0);
  parallel_for(shell.triangles.size(), kTrianglesAtATime, threads, [&](std::size_t begin, std::size_t end) {
    for (auto t = static_cast<Index>(begin); t < end; ++t) {
      const Vector here = normals(t);
      for (Index side = 3 * t; side < 3 * t + 3; ++side) {
        const Index other = adjacency.opposite[side];
        if (!is_paired(other) || other < side) continue;
        const Vector there = normals(triangle_of(other));
        const bool same_way = side_start(shell.triangles, side) == side_start(shell.triangles, other);
        const double dot = same_way ? -here.dot(there) : here.dot(there);
        smooth[side] = smooth[other] = dot >= cosine * std::sqrt(here.squaredNorm() * there.squaredNorm());
      }
    }
  });
  return smooth;
}

}  // namespace meshcontour::detail
