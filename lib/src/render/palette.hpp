#pragma once

#include <array>

#include "meshcontour/render.hpp"

namespace meshcontour::detail {

/// `share` of the other colour, 0 to 1; opaque.
Rgba mixed(const Rgba& color, const Rgba& other, double share);

/// The colours of lines and points.
struct Palette {
  Rgba mesh, edges, curves, wireframe, points, control, knots, annotations, tree, path, scale;
  std::array<Rgba, 3> axes;  ///< x, y, z
};

/// Colours that can be told from one another and from the background.
Palette make_palette(const RenderOptions& options);

}  // namespace meshcontour::detail
