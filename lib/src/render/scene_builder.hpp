#pragma once

#include <span>

#include "meshcontour/render.hpp"
#include "render/scene.hpp"

namespace meshcontour::detail {

/// The picture as the drawing modules take it: camera, placements and the batches of the layers.
///
/// Triangles, lines and curves are stored once a shell, however often it is placed.
///
/// @throws Error  BadData if the model is too large for numbers.
Scene build_scene(const Model& model, std::span<const ShellBoundary> boundaries,
                  std::span<const Contour> contours, const RenderOptions& options);

}  // namespace meshcontour::detail
