#pragma once

// Comparison of pictures, and PNG files read by an independent decoder.

#include <filesystem>
#include <span>

#include "meshcontour/render.hpp"

namespace pictures {

/// The share of pixels that differ by more than `levels` in some channel, 0 to 1; 1 if the sizes differ.
double differing_share(const meshcontour::Image& a, const meshcontour::Image& b, int levels);

/// @throws std::runtime_error  if it is no PNG.
meshcontour::Image decode_png(std::span<const std::uint8_t> bytes);
meshcontour::Image read_png(const std::filesystem::path& file);

/// Both pictures and what differs, white on black, side by side.
meshcontour::Image side_by_side(const meshcontour::Image& a, const meshcontour::Image& b, int levels);

}  // namespace pictures
