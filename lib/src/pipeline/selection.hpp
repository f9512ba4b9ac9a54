#pragma once

#include "meshcontour/pipeline.hpp"

namespace meshcontour::detail {

/// Takes the triangles of all other patches out of the model. Patches keep their numbers; points stay.
///
/// @throws Error  Usage if nothing is left.
void keep_selection(Model& model, const PatchSelection& selection);

}  // namespace meshcontour::detail
