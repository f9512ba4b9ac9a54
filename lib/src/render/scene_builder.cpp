#include "render/scene_builder.hpp"

#include <algorithm>
#include <cmath>

#include "meshcontour/parallel.hpp"
#include "render/layers.hpp"
#include "render/tiny_placements.hpp"

namespace meshcontour::detail {
namespace {

bool drawn(const RenderOptions& options, Layer layer) {
  return std::ranges::find(options.layers, layer) != options.layers.end();
}

// The box of a model in the axes of a view, about a point of the model: far from the origin the differences
// are exact, the coordinates are not.
class Extent {
 public:
  Extent(const Model& model, const RenderOptions& options)
      : model_(model), axes_(view_axes(options.view, options.up)), threads_(options.threads) {
    reference_ = first_point();
    for (const Instance& instance : model.instances) add(instance);
    if (drawn(options, Layer::Annotations)) add_annotations();
    if (drawn(options, Layer::Curves)) add_curves();
    if (drawn(options, Layer::Frames)) add_frames();
  }

  const Box& box() const { return box_; }
  const Point& reference() const { return reference_; }

 private:
  static constexpr std::size_t kGrain = 16384;

  Point first_point() const {
    for (const Instance& instance : model_.instances) {
      const Shell& shell = model_.shells[instance.shell];
      if (!shell.triangles.empty()) return instance.placement * shell.points[shell.triangles[0][0]];
    }
    for (const Polyline& line : model_.annotations) {
      if (!line.points.empty()) return line.points[0];
    }
    return model_.curves.empty() ? Point(0, 0, 0) : evaluate(model_.curves[0].curve, 0);
  }

  void add(const Point& p) { box_.extend(Point(axes_ * (p - reference_))); }

  void add(const Instance& instance) {
    const Shell& shell = model_.shells[instance.shell];
    const Eigen::Matrix3d linear = axes_ * instance.placement.linear();
    const Vector shift = axes_ * (instance.placement.translation() - reference_);
    std::vector<Box> parts((shell.triangles.size() + kGrain - 1) / kGrain);
    parallel_for(shell.triangles.size(), kGrain, threads_, [&](std::size_t begin, std::size_t end) {
      Box part;
      for (std::size_t t = begin; t < end; ++t) {
        for (const Index v : shell.triangles[t]) part.extend(Point(linear * shell.points[v] + shift));
      }
      parts[begin / kGrain].extend(part);
    });
    for (const Box& part : parts) box_.extend(part);
  }

  void add_annotations() {
    for (const Polyline& line : model_.annotations) {
      for (const Point& p : line.points) add(p);
    }
  }

  void add_curves() {
    constexpr int kSamples = 64;  // what bulges between them is less than the picture's margin
    for (const NamedCurve& named : model_.curves) {
      for (int i = 0; i <= kSamples; ++i) add(evaluate(named.curve, static_cast<double>(i) / kSamples));
    }
  }

  void add_frames() {
    const double length = frame_axis_length(model_);
    for (const NamedCurve& named : model_.curves) {
      for (const CurveFrame& frame : named.frames) {
        for (const Vector& axis : {frame.normal, frame.binormal, frame.tangent}) {
          add(frame.position);
          add(frame.position + length * axis);
        }
      }
    }
  }

  const Model& model_;
  Eigen::Matrix3d axes_;
  unsigned threads_;
  Point reference_ = Point::Zero();
  Box box_;
};

Camera fitted_camera(const Model& model, const RenderOptions& options) {
  if (options.view == View::Report) return make_camera(Box(), Point::Zero(), options);
  const Extent extent(model, options);
  return make_camera(extent.box(), extent.reference(), options);
}

void add_frames(Drawing& drawing) {
  std::size_t patches = 0;
  for (const Shell& shell : drawing.model.shells) {
    const Box box = bounding_box(shell);
    drawing.frames.push_back(local_frame(box));
    drawing.extents.push_back(box.isEmpty() ? Vector::Zero()
                                            : Vector(box.sizes() / 2 / drawing.frames.back().size));
    drawing.first_patch.push_back(patches);
    patches += shell.patches.size();
  }
  drawing.frames.push_back({drawing.camera.center, 1 / drawing.camera.scale});
  drawing.magnification.assign(drawing.frames.size(), 0);
  for (const Instance& instance : drawing.model.instances) {
    double& largest = drawing.magnification[instance.shell];
    largest = std::max(largest, instance.placement.linear().colwise().norm().maxCoeff());
  }
  drawing.magnification.back() = 1;
}

float line_scale(const RenderOptions& options) {
  constexpr float kReferenceSide = 900;  // pixels
  return std::max(1.0F, static_cast<float>(std::min(options.width, options.height)) / kReferenceSide);
}

// Numbers do not mix.
int samples_across(const RenderOptions& options) {
  return options.color_by == ColorBy::Number || options.samples == 1 ? 1 : options.samples == 4 ? 2 : 4;
}

std::array<std::uint8_t, 4> premultiplied(const std::optional<Rgba>& color) {
  if (!color) return {0, 0, 0, 0};
  const auto times_alpha = [&](int channel) {
    return static_cast<std::uint8_t>((channel * color->alpha + 127) / 255);
  };
  return {times_alpha(color->red), times_alpha(color->green), times_alpha(color->blue), color->alpha};
}

// Pixels from the lower left corner, right before the viewer.
Placement picture_placement(const Scene& scene) {
  constexpr double kNear = -0.999;
  Eigen::Matrix4d to_clip = Eigen::Matrix4d::Identity();
  to_clip.diagonal() << 2.0 / scene.width, 2.0 / scene.height, -1e-3, 1;
  to_clip.topRightCorner<3, 1>() << -1, -1, kNear;
  const Eigen::Matrix4d to_eye = scene.projection.inverse() * to_clip;
  return {to_eye.cast<float>(), to_eye(2, 3), false};
}

void place_frames(const Drawing& drawing, Scene& scene) {
  const auto& instances = drawing.model.instances;
  scene.frames.resize(drawing.frames.size());
  std::vector<std::size_t> counts(scene.frames.size(), 0);
  for (const Instance& instance : instances) ++counts[instance.shell];
  for (std::size_t s = 0; s < counts.size(); ++s) scene.frames[s].reserve(counts[s]);
  for (const Instance& instance : instances) {
    const LocalFrame& frame = drawing.frames[instance.shell];
    scene.frames[instance.shell].push_back(place(drawing.camera, frame, instance.placement));
  }
  scene.frames.back().push_back(place(drawing.camera, drawing.frames.back(), Eigen::Affine3d::Identity()));
  scene.frames.push_back({picture_placement(scene)});
}

void apply(const LayerStyle& style, std::size_t first_batch, Scene& scene) {
  for (std::size_t b = first_batch; b < scene.batches.size(); ++b) {
    Batch& batch = scene.batches[b];
    if (style.width && batch.kind != Batch::Kind::Triangles) batch.size = static_cast<float>(*style.width);
    if (!style.color) continue;
    for (std::size_t v = batch.range.first; v < batch.range.first + batch.range.count; ++v)
      scene.vertices[v].color = *style.color;
    for (CurveRun& run : batch.runs) run.color = *style.color;
  }
}

void add_styled_layer(const Drawing& drawing, Layer layer, Scene& scene) {
  const std::size_t first_batch = scene.batches.size();
  add_layer(drawing, layer, scene);
  for (const LayerStyle& style : drawing.options.styles) {
    if (style.layer == layer) apply(style, first_batch, scene);
  }
}

}  // namespace

Scene build_scene(const Model& model, std::span<const ShellBoundary> boundaries,
                  std::span<const Contour> contours, const RenderOptions& options) {
  Drawing drawing{model, boundaries, contours, options, fitted_camera(model, options), make_palette(options)};
  drawing.line_scale = line_scale(options);
  add_frames(drawing);
  Scene scene;
  scene.width = options.width;
  scene.height = options.height;
  scene.samples_across = samples_across(options);
  scene.lit = options.shading != Shading::None && options.color_by != ColorBy::Number;
  scene.projection = drawing.camera.projection;
  scene.background = premultiplied(options.background);
  place_frames(drawing, scene);
  constexpr double kLayerStep = 1e-4;  // eye units: a fraction of a pixel
  for (const Layer layer : options.layers) {
    drawing.bias += kLayerStep;
    if (!is_legend(layer)) add_styled_layer(drawing, layer, scene);
  }
  leave_out_tiny(scene, drawing.extents);
  scene.model_batches = scene.batches.size();
  for (const Layer layer : options.layers) {
    if (is_legend(layer)) add_styled_layer(drawing, layer, scene);
  }
  return scene;
}

}  // namespace meshcontour::detail
