#pragma once

#include <span>

#include "fit/model_evidence.hpp"
#include "fit/model_recognition.hpp"
#include "meshcontour/model.hpp"

namespace meshcontour::detail {

/// What the arcs of a model with three or more chords say: the tessellator's limits, and which circles there
/// are.
ModelEvidence gather_evidence(std::span<const ShellRecognition> shells);

/// The step of a shell's coordinates: 10^-d when they were written with d decimals or so many digits, 2^-24
/// of the largest when they are single precision, 0 when they are better than that. From a few thousand
/// points.
double coordinate_quantum(const Shell& shell);

}  // namespace meshcontour::detail
