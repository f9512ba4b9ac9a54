#include "model/sharp_sides.hpp"

#include <algorithm>
#include <cmath>

#include "base/large_array.hpp"
#include "meshcontour/parallel.hpp"

namespace meshcontour::detail {
namespace {

constexpr std::size_t kTrianglesAtATime = 1 << 14;

// A triangle lower than this part of the model's size has no direction that could be relied on:
// single-precision coordinates move its corners by about as much.
constexpr double kThinnestReliable = 0x1p-22;

// Rounding must not tell apart edges that are folded by just the angle, as those of a chamfer are: all of
// them count as sharp.
constexpr double kAngleRounding = 1e-4;  // radians

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
  Vector operator()(Index triangle) const {
    if (thin_.empty()) return area_vector(triangle);
    const auto thin = std::ranges::lower_bound(thin_, triangle);
    const bool is_thin = thin != thin_.end() && *thin == triangle;
    return area_vector(is_thin ? stand_in_[static_cast<std::size_t>(thin - thin_.begin())] : triangle);
  }

 private:
  Vector edge(Index side) const {
    const Point& from = shell_.points[side_start(shell_.triangles, side)];
    const Point& to = shell_.points[side_end(shell_.triangles, side)];
    return scale_ * to - scale_ * from;
  }

  Vector area_vector(Index triangle) const { return edge(3 * triangle).cross(edge(3 * triangle + 1)); }

  bool is_thin(Index triangle) const {
    const Vector a = edge(3 * triangle), b = edge(3 * triangle + 1);
    const double longest = std::max({a.squaredNorm(), b.squaredNorm(), (a + b).squaredNorm()});
    return a.cross(b).squaredNorm() <= thinnest_ * thinnest_ * longest;
  }

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
  std::vector<Index> thin_;      // sorted
  std::vector<Index> stand_in_;  // parallel to thin_: the triangle whose direction is taken
};

void TriangleNormals::find_thin(unsigned threads) {
  const std::size_t count = shell_.triangles.size();
  std::vector<std::vector<Index>> found((count + kTrianglesAtATime - 1) / kTrianglesAtATime);
  parallel_for(count, kTrianglesAtATime, threads, [&](std::size_t begin, std::size_t end) {
    for (auto t = static_cast<Index>(begin); t < end; ++t) {
      if (is_thin(t)) found[begin / kTrianglesAtATime].push_back(t);
    }
  });
  for (const std::vector<Index>& part : found) thin_.insert(thin_.end(), part.begin(), part.end());
}

// Walks over thin triangles across their longest sides until one is reached that has a direction. Each is
// walked once; a walk that ends at a border or bites its own tail leaves the triangles their own directions.
void TriangleNormals::find_stand_ins(const Adjacency& adjacency) {
  constexpr Index kUnknown = kNoSide, kOnTheWay = kManySides;
  stand_in_.assign(thin_.size(), kUnknown);
  const auto place_of = [&](Index t) {
    const auto thin = std::ranges::lower_bound(thin_, t);
    return thin != thin_.end() && *thin == t ? static_cast<std::size_t>(thin - thin_.begin()) : thin_.size();
  };
  std::vector<std::size_t> walk;
  for (std::size_t first = 0; first < thin_.size(); ++first) {
    std::size_t place = first;
    Index target = kOnTheWay;  // where the walk ends, if it ends well
    for (walk.clear(); stand_in_[place] == kUnknown;) {
      stand_in_[place] = kOnTheWay;
      walk.push_back(place);
      const Index across = adjacency.opposite[longest_side(thin_[place])];
      if (!is_paired(across)) break;
      const std::size_t next = place_of(triangle_of(across));
      if (next == thin_.size()) {
        target = triangle_of(across);
        break;
      }
      place = next;
      target = stand_in_[place];
    }
    for (const std::size_t w : walk) stand_in_[w] = is_paired(target) ? target : thin_[w];
  }
}

}  // namespace

std::vector<std::uint8_t> smooth_sides(const Shell& shell, const Adjacency& adjacency, double radians,
                                       unsigned threads) {
  const TriangleNormals normals(shell, adjacency, threads);
  const double cosine = std::cos(radians - kAngleRounding);
  std::vector<std::uint8_t> smooth;
  assign_large<std::uint8_t>(smooth, adjacency.opposite.size(), 0);
  parallel_for(shell.triangles.size(), kTrianglesAtATime, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<Vector> near(end - begin);  // most neighbours are near
    for (std::size_t t = begin; t < end; ++t) near[t - begin] = normals(static_cast<Index>(t));
    for (auto side = static_cast<Index>(3 * begin); side < 3 * end; ++side) {
      const Index other = adjacency.opposite[side];
      if (!is_paired(other) || other < side) continue;
      const Vector here = near[triangle_of(side) - begin];
      const Vector there =
          triangle_of(other) < end ? near[triangle_of(other) - begin] : normals(triangle_of(other));
      const bool same_way = side_start(shell.triangles, side) == side_start(shell.triangles, other);
      const double dot = same_way ? -here.dot(there) : here.dot(there);
      smooth[side] = smooth[other] = dot >= cosine * std::sqrt(here.squaredNorm() * there.squaredNorm());
    }
  });
  return smooth;
}

}  // namespace meshcontour::detail
