#pragma once

#include <span>
#include <vector>

#include "meshcontour/render.hpp"
#include "render/camera.hpp"
#include "render/palette.hpp"
#include "render/scene.hpp"

namespace meshcontour::detail {

/// What the layers are made of. Frame i is shell i's; the last is for what is given in the model's own frame.
struct Drawing {
  const Model& model;
  std::span<const ShellBoundary> boundaries;
  std::span<const Contour> contours;
  const RenderOptions& options;
  Camera camera;
  Palette palette;
  std::vector<LocalFrame> frames{};
  std::vector<Eigen::Vector3d> extents{};  ///< of each shell: its points lie within +- these in its frame
  std::vector<double> magnification{};     ///< of the largest placement of each frame; 0 when it has none
  std::vector<std::size_t> first_patch{};  ///< number of a shell's first patch over the whole model
  float line_scale = 1;                    ///< larger pictures have wider lines
  double bias = 0;                         ///< of the layer that is being added: later layers lie in front
};

/// Appends the batches of a layer.
void add_layer(const Drawing& drawing, Layer layer, Scene& scene);

/// Layers that are curves, each in a file of its own.
void add_curves(const Drawing& drawing, Scene& scene);
void add_control(const Drawing& drawing, Scene& scene);
void add_frames(const Drawing& drawing, Scene& scene);
void add_axes(const Drawing& drawing, Scene& scene);
void add_scale(const Drawing& drawing, Scene& scene);

/// Whether a layer tells how to read the picture instead of showing the model.
bool is_legend(Layer layer);

/// The length at which the axes of curve frames are drawn, model units; 0 when the model has none.
double frame_axis_length(const Model& model);

/// Whether the frame occurs in the picture.
bool placed(const Drawing& drawing, std::size_t frame);

/// A batch of lines or points of one frame.
Batch make_batch(const Drawing& drawing, Batch::Kind kind, std::size_t frame, float size);

/// Appends the batch and its vertices if there is something to draw.
void append(Scene& scene, Batch&& batch, const std::vector<Vertex>& vertices);

/// A point of a frame as a vertex.
Vertex flat_vertex(const LocalFrame& frame, const Point& p, const Rgba& color);

/// Whether each patch has lines of a colour of its own.
bool patches_have_lines(const Drawing& drawing);

/// That colour; dark enough beside the patch's faces, unless it is the patch's number.
Rgba patch_line_color(const Drawing& drawing, std::size_t shell, std::size_t patch);

}  // namespace meshcontour::detail
