#pragma once

#include <vector>

#include "fit/model_recognition.hpp"

namespace meshcontour::detail {

/// Fits the B-splines of a shell again where they run into a line, arc or ellipse in nearly its direction,
/// now with the very tangent of that. Those that would leave the tolerance stay as they are.
///
/// @param settings  one a chain, as for recognize.
void make_splines_tangent(const std::vector<RecognitionOptions>& settings, ShellRecognition& recognition,
                          unsigned threads);

}  // namespace meshcontour::detail
