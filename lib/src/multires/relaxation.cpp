#include "multires/relaxation.hpp"

#include <algorithm>

#include "multires/patches.hpp"
#include "multires/triangle_shape.hpp"

namespace meshcontour::detail {
namespace {

constexpr double kGoodShape = 0.2;  // of triangles; better ones may become worse
constexpr double kUnfoldedShape = 0.02;
constexpr double kTurned = 10;       // what a triangle that is turned over lacks besides
constexpr double kLeastPart = 0.05;  // of the way to the middle of the neighbours

}  // namespace

Relaxation::Relaxation(const Shell& fine, const MeshLevel& finest, const Shell& shell,
                       const SurfaceWalk& walk, std::vector<SurfacePlace> places)
    : finest_(finest),
      walk_(walk),
      places_(std::move(places)),
      patches_(patch_of_triangles(shell)),
      fine_patches_(patch_of_triangles(fine)) {
  for (const SurfacePlace& place : places_) points_.push_back(walk.point(place));
}

void Relaxation::around(Index v) {
  ring_.clear();
  Index h = finest_.outgoing[v];
  do {
    ring_.push_back(h);
    h = finest_.twins[MeshLevel::previous(h)];
  } while (h != MeshLevel::kNone && h != finest_.outgoing[v]);
}

// Below 0 if it is turned over, beside the surface at its corners. Of what lies in other patches nothing is
// known.
double Relaxation::shape(Index triangle) const {
  const auto [a, b, c] = finest_.triangles[triangle];
  const Vector x = points_[b] - points_[a], y = points_[c] - points_[a];
  const double sides = x.squaredNorm() + y.squaredNorm() + (x - y).squaredNorm();
  Vector normal = Vector::Zero();
  for (const Index v : {a, b, c}) {
    const Index there = places_[v].triangle;
    if (patches_[there] == fine_patches_[triangle]) normal += walk_.normal(there);
  }
  const Vector cross = x.cross(y);
  const double doubled_area = cross.norm();
  return triangle_shape(cross.dot(normal) < 0 ? -doubled_area : doubled_area, sides);
}

// What all triangles around a vertex lack to a good shape, or to one as bad as `least`.
double Relaxation::lack_around(double least) const {
  double lack = 0;
  for (const Index h : ring_) {
    const double own = shape(h / 3);
    lack += std::max(0.0, least - own) + (own < 0 ? kTurned : 0);
  }
  return lack;
}

// Part of the way to the middle of the neighbours, as long as that makes nothing worse.
bool Relaxation::move(Index v, double part, double least) {
  around(v);
  Point sum = Point::Zero();
  for (const Index h : ring_) sum += points_[finest_.end(h)];
  const double before = lack_around(least);
  const SurfacePlace old_place = places_[v];
  const Point old_point = points_[v];
  places_[v] = walk_.from(old_place, part * (sum / static_cast<double>(ring_.size()) - old_point));
  points_[v] = walk_.point(places_[v]);
  if (lack_around(least) <= before) return true;
  places_[v] = old_place;
  points_[v] = old_point;
  return false;
}

void Relaxation::smooth(Index first, const std::vector<bool>& kept) {
  for (Index v = first; v < finest_.vertex_count; ++v) {
    const bool inside = finest_.outgoing[v] != MeshLevel::kNone && finest_.sharp_edges[v] == 0;
    if (inside && !kept[places_[v].triangle]) move(v, 1, kGoodShape);
  }
}

std::vector<Index> Relaxation::flipped() const {
  std::vector<Index> found;
  for (Index t = 0; t < finest_.triangles.size(); ++t) {
    if (shape(t) < 0) found.push_back(t);
  }
  return found;
}

std::size_t Relaxation::unfold() {
  std::vector<bool> chosen(finest_.vertex_count, false), corner = chosen;
  const std::vector<Index> turned = flipped();
  for (const Index t : turned) {
    for (const Index v : finest_.triangles[t]) {
      if (corner[v]) continue;
      around(v);
      corner[v] = chosen[v] = true;
      for (const Index h : ring_) chosen[finest_.end(h)] = true;
    }
  }
  for (Index v = 0; v < finest_.vertex_count && !turned.empty(); ++v) {
    if (!chosen[v] || finest_.sharp_edges[v] != 0) continue;
    for (double part = 1; part > kLeastPart && !move(v, part, kUnfoldedShape); part /= 2) {
    }
  }
  return turned.size();
}

}  // namespace meshcontour::detail
