#pragma once

#include <vector>

#include "fit/evidence.hpp"
#include "fit/piece.hpp"
#include "fit/recognition.hpp"

namespace meshcontour::detail {

/// Splits a part of a run that holds no recognized piece: one arc or ellipse, or B-splines between the soft
/// corners, with long chords as lines between them.
///
/// @param run   what the part belongs to: its hard ends say nothing about the turning there.
/// @param part  points begin .. end of it; a ring when it is the whole of a closed path without hard ends.
std::vector<Piece> split_free_form(const Path& path, const Run& run, const Run& part, double eps,
                                   const RecognitionOptions& options, SplineCache& splines);

}  // namespace meshcontour::detail
