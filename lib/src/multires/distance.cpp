#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "meshcontour/parallel.hpp"
#include "meshcontour/simplification.hpp"
#include "multires/triangle_tree.hpp"

namespace meshcontour {
namespace {

using detail::Corners;
using detail::TriangleTree;

constexpr double kSlack = 0.02;       // a bound so close above the largest distance seen is good enough
constexpr double kResolution = 1e-7;  // of the size: distances below need not be told apart
constexpr int kMostCuts = 8;          // of a part in a row; rounding can make two triangles cut it for ever
constexpr double kRounding = 1e-14;   // of a coordinate
constexpr std::size_t kGrain = 256;

using Polygon = std::vector<Point>;  // convex

// A part of one triangle.
struct Part {
  Polygon polygon;
  std::optional<Index> cut_by = {};  // the triangle beyond one of whose sides it lies
  int cuts = 0;                      // since it was halved
};

Point centre_of(const Polygon& polygon) {
  Point sum = Point::Zero();
  for (const Point& p : polygon) sum += p;
  return sum / static_cast<double>(polygon.size());
}

// The parts of a polygon on both sides of a plane; a side with less than a triangle is empty. Corners whose
// height above it is no larger than `rounding` count as in it.
std::pair<Polygon, Polygon> split(const Polygon& polygon, const Point& origin, const Vector& normal,
                                  double rounding = 0) {
  std::pair<Polygon, Polygon> parts;
  bool flat = true;
  const auto height = [&](const Point& p) {
    const double above = normal.dot(p - origin);
    return std::abs(above) <= rounding ? 0 : above;
  };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double a = height(p), b = height(q);
    flat = flat && a == 0;
    if (a >= 0) parts.first.push_back(p);
    if (a <= 0) parts.second.push_back(p);
    if ((a > 0 && b < 0) || (a < 0 && b > 0)) {
      const Point cut = p + a / (a - b) * (q - p);
      parts.first.push_back(cut);
      parts.second.push_back(cut);
    }
  }
  // What lies in the plane as a whole belongs to the first side.
  if (parts.first.size() < 3) parts.first.clear();
  if (parts.second.size() < 3 || flat) parts.second.clear();
  return parts;
}

// How far the surface in a tree is from parts of a triangle.
class Overlay {
 public:
  /// Bounds of at most `enough` are not improved.
  Overlay(const TriangleTree& tree, double enough, double resolution)
      : tree_(tree), enough_(enough), resolution_(resolution) {}

  void measure(const Corners& triangle) {
    parts_.assign(1, {Polygon(triangle.begin(), triangle.end())});
    while (!parts_.empty()) {
      const Part part = std::move(parts_.back());
      parts_.pop_back();
      settle(part);
    }
  }

  /// Over all that was measured.
  const SurfaceDistance& distance() const { return distance_; }

 private:
  struct Corner {
    double distance = -1;
    Point point = Point::Zero();
  };

  // The distance to a triangle is convex, so a corner of the polygon has the largest.
  Corner farthest(const Polygon& part, const Corners& triangle) const {
    Corner worst;
    for (const Point& p : part) {
      const double distance = (detail::nearest_point(triangle, p) - p).norm();
      if (distance > worst.distance) worst = {distance, p};
    }
    return worst;
  }

  void see(double distance) {
    distance_.lower = std::max(distance_.lower, distance);
    enough_ = std::max(enough_, (1 + kSlack) * distance);
  }

  bool accepts(double bound) {
    if (bound > enough_) return false;
    distance_.upper = std::max(distance_.upper, bound);
    return true;
  }

  // Takes a polygon's bound, or pushes the parts that need a closer look.
  void settle(const Part& whole) {
    const Polygon& part = whole.polygon;
    const Point centre = centre_of(part);
    const TriangleTree::Hit hit = tree_.nearest(centre, last_);
    last_ = hit.triangle;
    const double at_centre = std::sqrt(hit.squared);
    see(at_centre);
    const Corners& triangle = tree_.corners(hit.triangle);
    double radius = 0;
    for (const Point& p : part) radius = std::max(radius, (p - centre).norm());
    const Corner worst = farthest(part, triangle);
    const double bound = std::min(worst.distance, at_centre + radius);
    if (accepts(bound)) return;
    see(std::sqrt(tree_.nearest(worst.point, last_).squared));
    if (accepts(bound)) return;
    if (radius <= resolution_) {
      distance_.upper = std::max(distance_.upper, bound);
    } else if (whole.cut_by == hit.triangle || whole.cuts == kMostCuts || !clip(whole, hit.triangle)) {
      halve(part, centre);
    }
  }

  // Cuts off what lies beyond the sides of the triangle; false if that is nothing or everything.
  bool clip(const Part& part, Index number) {
    const Corners& triangle = tree_.corners(number);
    const Vector normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
    double size = 0;
    for (const Point& p : triangle) size = std::max(size, p.cwiseAbs().maxCoeff());
    Polygon inside = part.polygon;
    std::vector<Part> outside;
    for (std::size_t k = 0; k < 3 && !inside.empty(); ++k) {
      const Vector across = normal.cross(triangle[(k + 1) % 3] - triangle[k]);
      // A corner that both surfaces share gives no splinters.
      auto [in, out] = split(inside, triangle[k], across, kRounding * size * across.norm());
      inside = std::move(in);
      if (!out.empty()) outside.push_back({std::move(out), number, part.cuts + 1});
    }
    if (inside.empty() || outside.empty()) return false;
    if (!accepts(farthest(inside, triangle).distance)) halve(inside, centre_of(inside));
    std::ranges::move(outside, std::back_inserter(parts_));
    return true;
  }

  void halve(const Polygon& part, const Point& centre) {
    Vector longest = Vector::Zero();
    for (std::size_t i = 0; i < part.size(); ++i) {
      const Vector side = part[(i + 1) % part.size()] - part[i];
      if (side.squaredNorm() > longest.squaredNorm()) longest = side;
    }
    auto [one, other] = split(part, centre, longest);
    if (!one.empty()) parts_.push_back({std::move(one)});
    if (!other.empty()) parts_.push_back({std::move(other)});
  }

  const TriangleTree& tree_;
  double enough_, resolution_;
  SurfaceDistance distance_;
  std::vector<Part> parts_;
  Index last_ = 0;  // triangle that was nearest to a part
};

// The largest over the triangles of one surface; every triangle's part depends on itself alone.
template <class Measure>
SurfaceDistance largest(std::size_t count, unsigned threads, const Measure& measure) {
  std::vector<SurfaceDistance> found((count + kGrain - 1) / kGrain);
  parallel_for(found.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t block = begin; block < end; ++block) {
      found[block] = measure(block * kGrain, std::min(count, (block + 1) * kGrain));
    }
  });
  SurfaceDistance all;
  for (const SurfaceDistance& d : found) {
    all.lower = std::max(all.lower, d.lower);
    all.upper = std::max(all.upper, d.upper);
  }
  return all;
}

// A first look: the vertices alone, each once however many triangles it has.
double vertex_distance(const Shell& from, std::size_t patch, const TriangleTree& to, unsigned threads) {
  std::vector<Index> vertices;
  for (const Triangle& t : from.patch_triangles(patch)) vertices.insert(vertices.end(), t.begin(), t.end());
  std::ranges::sort(vertices);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return largest(vertices.size(), threads,
                 [&](std::size_t begin, std::size_t end) {
                   double squared = 0;
                   TriangleTree::Hit hit;
                   for (std::size_t i = begin; i < end; ++i) {
                     hit = to.nearest(from.points[vertices[i]], hit.triangle);
                     squared = std::max(squared, hit.squared);
                   }
                   return SurfaceDistance{std::sqrt(squared), 0};
                 })
      .lower;
}

SurfaceDistance one_sided(const TriangleTree& from, const TriangleTree& to, double enough, double resolution,
                          unsigned threads) {
  return largest(from.size(), threads, [&](std::size_t begin, std::size_t end) {
    Overlay overlay(to, enough, resolution);
    for (std::size_t t = begin; t < end; ++t) overlay.measure(from.corners(static_cast<Index>(t)));
    return overlay.distance();
  });
}

}  // namespace

SurfaceDistance patch_distance(const Shell& a, const Shell& b, unsigned threads) {
  if (a.patches.size() != b.patches.size()) {
    throw Error(ErrorCode::Internal, fmt::format("{} patches and {}", a.patches.size(), b.patches.size()));
  }
  SurfaceDistance all;
  const double resolution = kResolution * bounding_box(a).diagonal().norm();
  for (std::size_t p = 0; p < a.patches.size(); ++p) {
    const TriangleTree one(a.points, a.patch_triangles(p)), other(b.points, b.patch_triangles(p));
    if (one.size() == 0 && other.size() == 0) continue;
    if (one.size() == 0 || other.size() == 0)
      throw Error(ErrorCode::Internal, fmt::format("patch {} is gone", p + 1));
    all.lower =
        std::max({all.lower, vertex_distance(a, p, other, threads), vertex_distance(b, p, one, threads)});
    const double enough = (1 + kSlack) * all.lower + resolution;
    for (const SurfaceDistance& d : {one_sided(one, other, enough, resolution, threads),
                                     one_sided(other, one, enough, resolution, threads)}) {
      all.lower = std::max(all.lower, d.lower);
      all.upper = std::max(all.upper, d.upper);
    }
  }
  all.upper = std::max(all.upper, all.lower);
  return all;
}

}  // namespace meshcontour
