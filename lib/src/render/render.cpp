#include "meshcontour/render.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>

#include "meshcontour/parallel.hpp"
#include "render/gl_module.hpp"
#include "render/layers.hpp"

namespace meshcontour {
namespace detail {
namespace {

constexpr int kLargestSide = 16384;
constexpr std::size_t kQuickTriangles = 200'000;  // above, compiling shaders well pays

void check(const Model& model, std::span<const ShellBoundary> boundaries, const RenderOptions& options) {
  if (options.width < 1 || options.height < 1 || options.width > kLargestSide ||
      options.height > kLargestSide) {
    throw Error(ErrorCode::Usage, fmt::format("a picture of {} x {} pixels: both must be 1 to {}",
                                              options.width, options.height, kLargestSide));
  }
  if (!boundaries.empty() && boundaries.size() != model.shells.size()) {
    throw Error(ErrorCode::Internal, "the boundaries are not those of the model");
  }
}

// The box of axes * (p - reference) over everything that is placed.
Box view_extent(const Model& model, const Eigen::Matrix3d& axes, const Point& reference, unsigned threads) {
  constexpr std::size_t kGrain = 16384;
  Box box;
  for (const Instance& instance : model.instances) {
    const Shell& shell = model.shells[instance.shell];
    const Eigen::Matrix3d linear = axes * instance.placement.linear();
    const Vector shift = axes * (instance.placement.translation() - reference);
    std::vector<Box> parts((shell.triangles.size() + kGrain - 1) / kGrain);
    parallel_for(shell.triangles.size(), kGrain, threads, [&](std::size_t begin, std::size_t end) {
      Box part;
      for (std::size_t t = begin; t < end; ++t) {
        for (const Index v : shell.triangles[t]) part.extend(Point(linear * shell.points[v] + shift));
      }
      parts[begin / kGrain].extend(part);
    });
    for (const Box& part : parts) box.extend(part);
  }
  for (const Polyline& line : model.annotations) {
    for (const Point& p : line.points) box.extend(Point(axes * (p - reference)));
  }
  return box;
}

// A point of the model near the others.
Point reference_point(const Model& model) {
  for (const Instance& instance : model.instances) {
    const Shell& shell = model.shells[instance.shell];
    if (!shell.triangles.empty()) return instance.placement * shell.points[shell.triangles[0][0]];
  }
  for (const Polyline& line : model.annotations) {
    if (!line.points.empty()) return line.points[0];
  }
  return Point::Zero();
}

Drawing make_drawing(const Model& model, std::span<const ShellBoundary> boundaries,
                     std::span<const Contour> contours, const RenderOptions& options) {
  Drawing drawing{model, boundaries, contours, options, {}, make_palette(options), {}, {}, {}};
  const Point reference = reference_point(model);
  const Eigen::Matrix3d axes = view_axes(options.view);
  drawing.camera = make_camera(view_extent(model, axes, reference, options.threads), reference, options);
  std::size_t patches = 0;
  for (const Shell& shell : model.shells) {
    drawing.frames.push_back(local_frame(bounding_box(shell)));
    drawing.first_patch.push_back(patches);
    patches += shell.patches.size();
  }
  drawing.frames.push_back({drawing.camera.center, 1 / drawing.camera.scale});
  drawing.magnification.assign(drawing.frames.size(), 0);
  for (const Instance& instance : model.instances) {
    double& largest = drawing.magnification[instance.shell];
    largest = std::max(largest, instance.placement.linear().colwise().norm().maxCoeff());
  }
  drawing.magnification.back() = 1;
  constexpr float kReferenceSide = 900;  // pixels
  drawing.line_scale =
      std::max(1.0F, static_cast<float>(std::min(options.width, options.height)) / kReferenceSide);
  return drawing;
}

std::array<double, 4> premultiplied(const std::optional<Rgba>& color) {
  if (!color) return {0, 0, 0, 0};
  const double alpha = color->alpha / 255.0;
  return {color->red / 255.0 * alpha, color->green / 255.0 * alpha, color->blue / 255.0 * alpha, alpha};
}

Scene make_scene(Drawing& drawing) {
  constexpr double kLayerStep = 1e-4;  // eye units: a tenth of a pixel
  Scene scene;
  scene.width = drawing.options.width;
  scene.height = drawing.options.height;
  scene.projection = drawing.camera.projection;
  scene.background = premultiplied(drawing.options.background);
  scene.frames.resize(drawing.frames.size());
  for (const Instance& instance : drawing.model.instances) {
    scene.frames[instance.shell].push_back(
        place(drawing.camera, drawing.frames[instance.shell], instance.placement));
  }
  scene.frames.back().push_back(place(drawing.camera, drawing.frames.back(), Eigen::Affine3d::Identity()));
  for (const Layer layer : drawing.options.layers) {
    drawing.bias += kLayerStep;
    add_layer(drawing, layer, scene);
  }
  return scene;
}

std::size_t drawn_triangles(const Model& model) {
  std::size_t count = 0;
  for (const Instance& instance : model.instances) count += model.shells[instance.shell].triangles.size();
  return count;
}

// Draws with the first backend that gives a context.
Image draw(const Scene& scene, const GlSettings& settings, GlBackend wanted) {
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  std::string failure;
  for (const GlBackend backend : backends(wanted)) {
    const GlApi* api = load_gl_module(backend, failure);
    if (api == nullptr) continue;
    Image image;
    const GlOutcome outcome = api->draw(scene, settings, image);
    switch (outcome.status) {
      case GlOutcome::Status::Done:
        return image;
      case GlOutcome::Status::OutOfMemory:
        throw Error(ErrorCode::OutOfMemory, outcome.message);
      case GlOutcome::Status::Failed:
        throw Error(ErrorCode::Internal, outcome.message);
      case GlOutcome::Status::NoContext:
        failure +=
            fmt::format("{}{}: {}", failure.empty() ? "" : "; ", backend_name(backend), outcome.message);
    }
  }
  throw Error(ErrorCode::NoRenderer, "no OpenGL renderer: " + failure);
}

}  // namespace
}  // namespace detail

Image render(const Model& model, std::span<const ShellBoundary> boundaries, std::span<const Contour> contours,
             const RenderOptions& options, std::vector<Diagnostic>& diagnostics) {
  detail::check(model, boundaries, options);
  detail::Drawing drawing = detail::make_drawing(model, boundaries, contours, options);
  detail::GlSettings settings;
  settings.threads = options.threads;
  settings.quick_compile = detail::drawn_triangles(model) <= detail::kQuickTriangles;
  (void)diagnostics;
  return detail::draw(detail::make_scene(drawing), settings, options.backend);
}

}  // namespace meshcontour
