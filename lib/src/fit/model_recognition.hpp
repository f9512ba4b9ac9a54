#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "fit/edge_chains.hpp"
#include "fit/recognition.hpp"
#include "meshcontour/fit.hpp"

namespace meshcontour::detail {

/// A loop of several chains that is one circle or ellipse.
struct ClosedConic {
  std::size_t patch = 0, loop = 0;
  Curve curve;  ///< full, in the shell's frame
  double residual = 0;
};

/// The chains of a shell and what they were recognized as.
struct ShellRecognition {
  ShellChains chains;
  std::vector<Recognition> fits;    ///< one a chain
  std::vector<ClosedConic> conics;  ///< in order of patch and loop
};

/// Recognizes all chains of a model, in parallel: each chain by itself, then loops that are one closed conic,
/// then what was left unclear with the evidence of the whole model; last, B-splines are made tangent to the
/// lines, arcs and ellipses that they run into.
std::vector<ShellRecognition> recognize_model(const Model& model, std::span<const ShellBoundary> boundaries,
                                              const FitOptions& options);

}  // namespace meshcontour::detail
