#pragma once

#include <cstdint>
#include <vector>

#include "meshcontour/render.hpp"

namespace meshcontour {

/// The image as a PNG file: 8 bits a channel, without alpha where every pixel is opaque. The same image gives
/// the same bytes.
///
/// @param image   width * height * 4 bytes.
/// @throws Error  Internal if the sizes do not match; OutOfMemory if there is not enough of it, or the
///                uncompressed file would be beyond 2 GiB.
std::vector<std::uint8_t> encode_png(const Image& image);

}  // namespace meshcontour
