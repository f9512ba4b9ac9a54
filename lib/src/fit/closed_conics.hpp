#pragma once

#include <vector>

#include "fit/model_recognition.hpp"

namespace meshcontour::detail {

/// Finds the loops of several chains that are one circle or ellipse, and makes each of their chains an arc of
/// it where the chain alone was not recognized as one.
///
/// A chain of a single chord speaks against it: a round edge has two or more between patch corners, the side
/// of a prism has one.
///
/// @param settings  one a chain, as for recognize.
void find_closed_conics(const Shell& shell, const ShellBoundary& boundary,
                        const std::vector<RecognitionOptions>& settings, ShellRecognition& recognition);

}  // namespace meshcontour::detail
