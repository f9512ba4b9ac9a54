#pragma once

#include <cstdint>

#include "render/scene.hpp"

namespace meshcontour::detail {

/// Refuses a picture that the memory cannot hold: the rasterizer does not survive a failed allocation.
///
/// @throws Error  OutOfMemory, naming what is needed and what there is.
void require_memory(const Scene& scene, int largest_tile);

/// Bytes that this process may still take: of the machine, of its control group, and of its own limit on
/// addresses.
std::uint64_t available_memory();

}  // namespace meshcontour::detail
