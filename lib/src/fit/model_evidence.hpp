#pragma once

#include <cstddef>
#include <vector>

#include "meshcontour/curve.hpp"

namespace meshcontour::detail {

/// Circles, findable by axis line and radius.
class CircleIndex {
 public:
  CircleIndex() = default;

  /// @param arcs  that lie on the circles.
  explicit CircleIndex(std::vector<CircularArc> arcs);

  /// Whether one of the circles has the arc's radius and axis line within `slack`, model units. O(log n); of
  /// very many circles at one place only some are looked at.
  bool has_coaxial(const CircularArc& arc, double slack) const;

 private:
  struct Entry {
    double place;  // of the axis line
    CircularArc arc;
  };

  double place_of(const CircularArc& arc) const;

  Point origin_ = Point::Zero();
  std::vector<Entry> entries_;  // by place
};

/// What the clearly recognized arcs of a shell say about the rest of it.
struct ShellEvidence {
  CircleIndex circles;
  std::vector<CircularArc> chords;  ///< circles that carry arcs of a single chord; `angle` is the widest
};

/// What the arcs of a model say.
struct ModelEvidence {
  double angle = 0;    ///< widest chord of an arc as seen from its centre, radians; 0: no arcs
  double sagitta = 0;  ///< largest sagitta of such a chord, model units
  std::vector<ShellEvidence> shells;

  bool known() const { return angle > 0; }
};

}  // namespace meshcontour::detail
