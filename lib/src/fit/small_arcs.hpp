#pragma once

#include <vector>

#include "fit/model_recognition.hpp"

namespace meshcontour::detail {

/// Circles that carry arcs of so few chords that only their number speaks for them.
struct SmallArcs {
  std::vector<CircularArc> pairs;  ///< circles with three or more arcs of two equal chords
  std::vector<CircularArc>
      chords;  ///< about the same axes, with three or more single chords; `angle` is the widest
};

/// Finds them among what was not recognized as anything longer. A tessellator that makes arcs of two chords
/// makes some of one; where no arc has two chords, none has one.
SmallArcs find_small_arcs(const ShellRecognition& shell);

/// The arc over one chord that belongs to the circle, both ends held; `near` has its centre and axis.
CircularArc arc_over_chord(const Point& start, const Point& end, const CircularArc& near);

/// Whether both ends of the chord lie on the circle within `slack`, and it is no wider than the circle's
/// widest.
bool is_chord_of(const Point& start, const Point& end, const CircularArc& circle, double slack);

}  // namespace meshcontour::detail
