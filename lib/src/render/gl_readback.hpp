#pragma once

#include "meshcontour/render.hpp"

namespace meshcontour::detail {

/// Where the pixels of the bound framebuffer belong in the picture: counted from the picture's lower left
/// corner, in pixels; `margin` samples of the framebuffer around them are not used.
struct Readback {
  int left, bottom, width, height, margin;
};

/// Averages 2 x 2 samples of the bound framebuffer to a pixel each, and turns colour times alpha to straight
/// alpha. Pixels beyond the picture's right and upper end are left out.
void average_into(Image& image, const Readback& part);

}  // namespace meshcontour::detail
