#pragma once

#include <span>

#include "meshcontour/simplification.hpp"

namespace meshcontour::detail {

/// Adds to the model's diagnostics what became of its shells: a note a shell, and a warning for all that kept
/// more triangles than they should.
void report_simplifications(const SimplifyOptions& options, std::span<const Simplification> simplifications,
                            Model& model);

}  // namespace meshcontour::detail
