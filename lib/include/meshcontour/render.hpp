#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "meshcontour/boundary.hpp"
#include "meshcontour/curve.hpp"

namespace meshcontour {

/// What can be drawn, one on top of the other.
enum class Layer { Mesh, Edges, Curves, Wireframe, Points, Control, Annotations };

enum class View { Iso, Front, Back, Left, Right, Top, Bottom, Report };
enum class ColorBy { File, Patch, Layer, Type };
enum class GlBackend { Automatic, OSMesa, Egl };

struct RenderOptions {
  int width = 1280, height = 960;  ///< pixels, 1 to 16384
  std::vector<Layer> layers = {Layer::Mesh, Layer::Edges, Layer::Curves};  ///< drawn in this order
  View view = View::Iso;
  std::optional<Rgba> background = Rgba{255, 255, 255, 255};  ///< none: transparent
  ColorBy color_by = ColorBy::File;
  GlBackend backend = GlBackend::Automatic;
};

/// Pixels with straight alpha, top row first, 4 bytes a pixel.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
};

/// Draws a model off screen with a software rasterizer, no display needed. Loads the rasterizer on first use.
///
/// @param boundaries, contours  may be empty when no layer needs them.
/// @throws Error  Usage if the size is out of range; NoRenderer if no context can be made or its self-test fails;
///                OutOfMemory if the rasterizer runs out of memory.
Image render(const Model& model, std::span<const ShellBoundary> boundaries, std::span<const Contour> contours,
             const RenderOptions& options = {});

}  // namespace meshcontour
