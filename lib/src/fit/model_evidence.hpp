#pragma once

#include <cstddef>
#include <vector>

#include "meshcontour/curve.hpp"

namespace meshcontour::detail {

/// What the clearly recognized arcs of a model say about the rest of it.
struct ModelEvidence {
  double angle = 0;    ///< widest chord of an arc as seen from its centre, radians; 0: no arcs
  double sagitta = 0;  ///< largest sagitta of such a chord, model units
  std::vector<std::vector<CircularArc>> arcs;  ///< by shell, sorted by radius

  bool known() const { return angle > 0; }

  /// Whether an arc of the shell lies on the same circle, or has the same radius and axis line, within
  /// `slack`.
  bool supports(std::size_t shell, const CircularArc& arc, double slack) const;
};

}  // namespace meshcontour::detail
