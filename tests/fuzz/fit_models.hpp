#pragma once

// Small models for the fit target: curves that are drawn step by step, as boundaries of patches that share
// them.

#include <vector>

#include "fuzz/targets.hpp"
#include "meshcontour/boundary.hpp"
#include "meshcontour/model.hpp"

namespace fuzz {

/// One shell and its boundaries.
struct FitModel {
  meshcontour::Model model;
  std::vector<meshcontour::ShellBoundary> boundaries;
};

/// Lines, arcs, spirals, corners, repeated and far points, from few bytes: as one loop, an open chain,
/// patches that meet along chains, a ring in parts, or a disc in a hole; once or several times over, joined
/// by vertices or by positions, exact or rounded, from 2^-330 to 2^330 large.
FitModel fit_model_of(Source& source);

}  // namespace fuzz
