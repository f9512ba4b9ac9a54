#pragma once

#include <functional>

#include "meshcontour/model.hpp"

namespace meshcontour::detail {

/// Calls body(shell, first, last) in parallel for runs of patches that together are all patches of the model,
/// each run a few thousand triangles or one patch. The runs depend on the model alone.
void for_each_patch(const Model& model, unsigned threads,
                    const std::function<void(std::size_t shell, std::size_t first, std::size_t last)>& body);

}  // namespace meshcontour::detail
