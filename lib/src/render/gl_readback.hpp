#pragma once

#include <array>

#include "meshcontour/render.hpp"

namespace meshcontour::detail {

/// Where the pixels of the bound framebuffer belong in the picture: counted from the picture's lower left
/// corner, in pixels of `across` x `across` samples; `margin` samples of the framebuffer around them are not
/// used.
struct Readback {
  int left, bottom, width, height, margin, across;
  std::array<std::uint8_t, 4> background;  ///< colour times alpha
};

/// Makes all pixels the background's, given as colour times alpha.
void fill_background(Image& image, const std::array<std::uint8_t, 4>& background);

/// Averages the samples of the bound framebuffer to pixels, and turns colour times alpha to straight alpha.
/// Pixels beyond the picture's right and upper end are left out; rows that are all background are left as
/// they are.
///
/// @return  whether a sample differs from the background.
bool average_into(Image& image, const Readback& part);

}  // namespace meshcontour::detail
