#pragma once

// What the builders of surfaces share.

#include <string>
#include <utility>
#include <vector>

#include "meshcontour/sweep.hpp"
#include "sweep/frames.hpp"
#include "sweep/sampling.hpp"

namespace meshcontour::detail {

/// A surface to build, with its curves sampled.
struct SurfaceTask {
  const SweepSurface& surface;
  const SweepCurve& profile_curve;
  const SampledCurve& profile;
  const SweepOptions& options;
  std::vector<Diagnostic>& diagnostics;

  void warn(std::string message) const {
    diagnostics.push_back({Diagnostic::Severity::Warning, std::move(message), surface.spot});
  }
};

/// The surface of the profile turned about the y axis or, for a cylinder along a circle, about the circle's
/// axis. The shell stays empty if the surface has no area.
///
/// @param circle_radius  of the circle; unused for a revolution.
void build_revolution(const SurfaceTask& task, std::size_t rings, double circle_radius, Shell& shell);

/// The profile carried along a sampled curve. The shell stays empty if the surface has no area.
void build_cylinder(const SurfaceTask& task, const SampledCurve& sweep, Shell& shell);

}  // namespace meshcontour::detail
