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
enum class Layer {
  Mesh,         ///< lit triangles
  Edges,        ///< boundary edges of the patches
  Curves,       ///< fitted contours, and the curves that the model itself gives
  Wireframe,    ///< all triangle edges
  Points,       ///< boundary vertices
  Control,      ///< control polygons, control points and knots of the fitted contours
  Frames,       ///< along the model's own curves: normal red, binormal green, tangent blue
  Detail,       ///< lit triangles, coloured by the size of the wavelet coefficients: Shell::details
  Annotations,  ///< line drawings that come with the model
  Tree,         ///< Model::tree: spanning trees of the patches
  Path,         ///< Model::path: the shortest path between two vertices
  Axes,         ///< the directions of x, y and z in the lower left corner, over everything else
  Scale,  ///< a bar of a round length in the lower right corner, over everything else; not in View::Report
};

/// Pixels: lines are no wider, points no larger.
inline constexpr double kWidestLine = 64;

/// Another look of a layer than its own.
struct LayerStyle {
  Layer layer = Layer::Edges;
  std::optional<Rgba> color;  ///< of everything in it, opaque
  std::optional<double>
      width;  ///< of its lines, or its points' diameter: pixels of the picture, up to kWidestLine
};

/// From where the model is seen, with Z up. Front looks along +Y with X to the right, right looks along -X
/// with Y to the right, top looks along -Z with X to the right and Y up; back, left and bottom are their
/// opposites, bottom with X to the right. Iso looks from (1, -1, 1): front, right and top at once. These are
/// orthographic and fit the model to the picture; Report is the fixed perspective of the report's figures, in
/// model units, in its colours.
enum class View { Iso, Front, Back, Left, Right, Top, Bottom, Report };

/// The axis of the model that points up in the named views; Z in CAD, Y in many graphics programs.
enum class UpAxis { X, Y, Z };

/// What a colour tells.
enum class ColorBy {
  File,    ///< the colours of the file, of points where it has them; edges and curves in one colour a layer
  Patch,   ///< one colour a patch, from a palette that repeats after 21
  Number,  ///< one colour a patch, its number: see patch_number_color; never mixed, never shaded
  Layer,   ///< one colour a layer
  Type,    ///< one colour a kind of segment: line, arc, circle, ellipse, spline; the rest grey
};

/// What light does to faces; lines and points are drawn in their own colours.
enum class Shading {
  Smooth,  ///< light from over the viewer's left shoulder
  None,    ///< none: faces are drawn in their own colours, too, those of ColorBy::Patch in patch_color
};

enum class GlBackend { Automatic, OSMesa, Egl };

struct RenderOptions {
  int width = 1280, height = 960;                                          ///< pixels, 1 to 16384
  std::vector<Layer> layers = {Layer::Mesh, Layer::Edges, Layer::Curves};  ///< drawn in this order
  View view = View::Iso;
  UpAxis up = UpAxis::Z;                                      ///< of no meaning to View::Report
  std::optional<Rgba> background = Rgba{255, 255, 255, 255};  ///< none: transparent
  ColorBy color_by = ColorBy::File;
  Shading shading = Shading::Smooth;
  int samples = 4;  ///< of a pixel, averaged: 1, 4 or 16; with 1 every pixel has the colour of one thing
  std::vector<LayerStyle> styles;            ///< later ones win
  GlBackend backend = GlBackend::Automatic;  ///< Automatic: OSMesa, or EGL where that is missing
  unsigned threads = 0;  ///< 0: one per processor; for the rasterizer the process's first call rules
};

/// Pixels with straight alpha, top row first, 4 bytes a pixel.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
};

/// Draws a model off screen with a software rasterizer, no display needed. Loads the rasterizer on first use.
///
/// Colours are opaque: the alpha of patches is not used. With one sample a pixel and no shading a picture has
/// no other colours than those of its layers and the background.
///
/// @param boundaries, contours  may be empty when no layer needs them.
/// @throws Error  Usage if the size, a width or the samples are out of range, or the layer Scale is asked for
/// in perspective;
///                NoRenderer if no context can be made or its self-test fails; OutOfMemory if the picture
///                needs more memory than there is, or the rasterizer runs out of it; BadData if the model is
///                too large for numbers (beyond 1e150), or if nothing would show.
Image render(const Model& model, std::span<const ShellBoundary> boundaries, std::span<const Contour> contours,
             const RenderOptions& options);

/// The names of the backends whose libraries are here, the preferred one first. Loads them.
std::vector<std::string> renderers();

/// The axes of a view in model coordinates: rows are the picture's right, its up, and towards the viewer.
Eigen::Matrix3d view_axes(View view, UpAxis up = UpAxis::Z);

/// The palette of ColorBy::Patch; any index.
Rgba patch_color(std::size_t patch);

/// The colour of ColorBy::Number for a patch, counted from 0 over all shells: its number, from 1 to 2^24 - 1
/// and then again, is 65536 red + 256 green + blue.
Rgba patch_number_color(std::size_t patch);

/// The palette of ColorBy::Type.
Rgba type_color(const Curve& curve);

}  // namespace meshcontour
