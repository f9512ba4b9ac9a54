#pragma once

#include <array>

#include "meshcontour/render.hpp"

namespace meshcontour::detail {

/// Where the pixels of the bound framebuffer belong in the picture: counted from the picture's lower left
/// corner, in pixels of `across` x `across` samples; `margin` samples of the framebuffer around them are not used.
struct Readback {
  int left, bottom, width, height, margin, across;
  std::array<double, 4> background;  ///< colour times alpha
};

/// Averages the samples of the bound framebuffer to pixels, and turns colour times alpha to straight
/// alpha. Pixels beyond the picture's right and upper end are left out.
///
/// @return  whether a sample differs from the background.
bool average_into(Image& image, const Readback& part);

}  // namespace meshcontour::detail
