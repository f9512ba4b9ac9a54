#pragma once

#include <span>
#include <vector>

#include "meshcontour/fit.hpp"

namespace meshcontour::detail {

/// The contours of all loops by the methods Approximate and Primitives, in order of shell, patch and loop.
///
/// Patches that meet along the same vertices get the same curves, numbered once a shell. Loops without a
/// contour (too few points, numbers out of range) come back without segments.
std::vector<Contour> chain_contours(const Model& model, std::span<const ShellBoundary> boundaries,
                                    const FitOptions& options);

}  // namespace meshcontour::detail
