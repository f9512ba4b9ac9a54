#pragma once

// Profiles of revolutions, split where they meet the axis.

#include <vector>

#include "sweep/profile.hpp"

namespace meshcontour::detail {

/// A part of a profile on one side of the axis (the y axis of the profile's plane). Poles are on the axis
/// exactly, and only at its ends.
struct Bead {
  Profile profile;
  bool first_pole = false, last_pole = false;
  bool first_cap = false, last_cap = false;  ///< the first or last span was added to close the bead

  bool right_of_axis() const;
};

/// The parts of a profile, in its order; at least one of their points is off the axis. Where the curve
/// crosses the axis between two samples, a point is inserted.
///
/// @param shift  is subtracted from x first.
std::vector<Bead> split_at_axis(const SweepCurve& curve, const SampledCurve& samples, double shift,
                                double corner_angle);

/// Leads the open ends of a bead straight to the axis.
void cap_ends(Bead& bead);

/// True if both beads, one of them mirrored, are the same points within `distance`, in either order.
bool coincide(const Bead& a, const Bead& b, double distance);

}  // namespace meshcontour::detail
