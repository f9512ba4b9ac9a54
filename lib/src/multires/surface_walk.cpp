#include "multires/surface_walk.hpp"

#include <algorithm>

namespace meshcontour::detail {
namespace {

constexpr int kMostTriangles = 64;  // on one way

}  // namespace

SurfaceWalk::SurfaceWalk(const Shell& shell, const MeshLevel& level) : shell_(shell), level_(level) {
  normals_.reserve(shell.triangles.size());
  for (const auto& [a, b, c] : shell.triangles) {
    const Point& at = shell.points[a];
    normals_.push_back((shell.points[b] - at).cross(shell.points[c] - at).stableNormalized());
  }
}

Point SurfaceWalk::point(const SurfacePlace& place) const {
  Point p = Point::Zero();
  for (std::size_t k = 0; k < 3; ++k)
    p += place.weights[k] * shell_.points[shell_.triangles[place.triangle][k]];
  return p;
}

// Goes on to a side of the triangle at most: the corner whose share is used up there, 3 where the way ends.
std::size_t SurfaceWalk::cross(SurfacePlace& place, Vector& way) const {
  const Triangle& t = shell_.triangles[place.triangle];
  const Vector& normal = normals_[place.triangle];
  const auto side = [&](std::size_t k) -> Vector {
    return shell_.points[t[(k + 2) % 3]] - shell_.points[t[(k + 1) % 3]];
  };
  const double area = side(0).cross(side(1)).dot(normal);
  if (!(area > 0)) return 3;
  way -= way.dot(normal) * normal;
  std::array<double, 3> change{};
  double part = 1;
  std::size_t corner = 3;
  for (std::size_t k = 0; k < 3; ++k) {
    change[k] = normal.cross(side(k)).dot(way) / area;
    if (place.weights[k] + part * change[k] >= 0) continue;
    part = place.weights[k] / -change[k];
    corner = k;
  }
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    place.weights[k] = k == corner ? 0 : std::max(0.0, place.weights[k] + part * change[k]);
    sum += place.weights[k];
  }
  for (double& weight : place.weights) weight /= sum;
  way *= 1 - part;
  return corner;
}

SurfacePlace SurfaceWalk::from(SurfacePlace place, Vector way) const {
  for (int step = 0; step < kMostTriangles; ++step) {
    const std::size_t corner = cross(place, way);
    if (corner == 3) return place;
    const Index h = 3 * place.triangle + static_cast<Index>((corner + 1) % 3), twin = level_.across(h);
    if (twin == MeshLevel::kNone) return place;
    // The part across the edge is unfolded into the next triangle.
    const Vector edge = (shell_.points[level_.end(h)] - shell_.points[level_.start(h)]).stableNormalized();
    const double across = way.dot(edge.cross(normals_[place.triangle]));
    SurfacePlace next{twin / 3, {}};
    next.weights[twin % 3] = place.weights[(corner + 2) % 3];
    next.weights[(twin + 1) % 3] = place.weights[(corner + 1) % 3];
    place = next;
    way = way.dot(edge) * edge + across * edge.cross(normals_[place.triangle]);
  }
  return place;
}

}  // namespace meshcontour::detail
