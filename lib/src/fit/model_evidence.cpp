#include "fit/model_evidence.hpp"

#include <algorithm>
#include <cmath>

namespace meshcontour::detail {

namespace {

constexpr std::size_t kMostCompared = 512;

}  // namespace

CircleIndex::CircleIndex(std::vector<CircularArc> arcs) {
  if (!arcs.empty()) origin_ = arcs[0].center;
  entries_.reserve(arcs.size());
  for (const CircularArc& arc : arcs) entries_.push_back({place_of(arc), arc});
  std::stable_sort(entries_.begin(), entries_.end(),
                   [](const Entry& a, const Entry& b) { return a.place < b.place; });
}

// The point of the axis line nearest to the origin, along a direction that no grid of holes is aligned with.
double CircleIndex::place_of(const CircularArc& arc) const {
  const Vector v = arc.center - origin_;
  return (v - v.dot(arc.axis) * arc.axis).dot(Vector(0.5715, 0.3107, 0.7595));
}

bool CircleIndex::has_coaxial(const CircularArc& arc, double slack) const {
  // An axis may lean by slack / radius, which moves its foot by that share of the distance.
  const double reach = slack * (1 + (arc.center - origin_).norm() / arc.radius);
  const double place = place_of(arc);
  auto other = std::lower_bound(entries_.begin(), entries_.end(), place - reach,
                                [](const Entry& entry, double least) { return entry.place < least; });
  for (std::size_t k = 0; k < kMostCompared && other != entries_.end() && other->place <= place + reach;
       ++k, ++other) {
    const CircularArc& known = other->arc;
    const Vector gap = arc.center - known.center;
    const bool parallel = arc.axis.cross(known.axis).norm() * arc.radius <= slack;
    const bool same_axis = (gap - gap.dot(known.axis) * known.axis).norm() <= slack;
    if (parallel && same_axis && std::abs(arc.radius - known.radius) <= slack) return true;
  }
  return false;
}

}  // namespace meshcontour::detail
