#pragma once

#include "render/scene.hpp"

namespace meshcontour::detail {

/// Samples, counted from the picture's lower left corner; `right` and `top` lie beyond.
struct Region {
  int left = 0, bottom = 0, right = 0, top = 0;

  int width() const { return right - left; }
  int height() const { return top - bottom; }
  bool empty() const { return width() <= 0 || height() <= 0; }
};

/// The part of the picture outside of which no sample is drawn, in blocks of 64 x 64 samples: the boxes of
/// what is drawn, placed and projected, and half a line's width around them. The whole picture where these
/// are too many to be worth it, or reach behind the viewer.
///
/// @param scene  with the chords of its curves.
Region drawn_region(const Scene& scene);

}  // namespace meshcontour::detail
