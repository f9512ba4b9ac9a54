#include "fit/model_evidence.hpp"

#include <algorithm>
#include <cmath>

namespace meshcontour::detail {

bool ModelEvidence::supports(std::size_t shell, const CircularArc& arc, double slack) const {
  if (shell >= arcs.size()) return false;
  const std::vector<CircularArc>& known = arcs[shell];
  auto other = std::lower_bound(known.begin(), known.end(), arc.radius - slack,
                                [](const CircularArc& a, double radius) { return a.radius < radius; });
  for (; other != known.end() && other->radius <= arc.radius + slack; ++other) {
    const Vector gap = arc.center - other->center;
    const double along = gap.dot(other->axis);
    const bool parallel = arc.axis.cross(other->axis).norm() * arc.radius <= slack;
    if (parallel && (gap - along * other->axis).norm() <= slack) return true;
  }
  return false;
}

}  // namespace meshcontour::detail
