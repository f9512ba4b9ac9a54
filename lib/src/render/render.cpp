#include "meshcontour/render.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>

#include "render/gl_module.hpp"
#include "render/memory.hpp"
#include "render/scene_builder.hpp"

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
  if (options.samples != 1 && options.samples != 4 && options.samples != 16) {
    throw Error(ErrorCode::Usage, fmt::format("{} samples a pixel: 1, 4 or 16", options.samples));
  }
  for (const LayerStyle& style : options.styles) {
    if (style.width && !(*style.width > 0 && *style.width <= kWidestLine)) {
      throw Error(ErrorCode::Usage, fmt::format("a line of {} pixels: up to {}", *style.width, kWidestLine));
    }
  }
  const bool has_scale = std::ranges::find(options.layers, Layer::Scale) != options.layers.end();
  if (has_scale && options.view == View::Report) {
    throw Error(ErrorCode::Usage, "the layer scale needs a view without perspective: every one but report");
  }
  if (!boundaries.empty() && boundaries.size() != model.shells.size()) {
    throw Error(ErrorCode::Internal, "the boundaries are not those of the model");
  }
  const auto finite = [](const Instance& instance) { return instance.placement.matrix().allFinite(); };
  if (!std::ranges::all_of(model.instances, finite)) {
    throw Error(ErrorCode::Internal, "a placement is not finite");
  }
}

std::size_t drawn_triangles(const Model& model) {
  std::size_t count = 0;
  for (const Instance& instance : model.instances) count += model.shells[instance.shell].triangles.size();
  return count;
}

// Draws with the first backend that gives a context.
Image draw(Scene& scene, const GlSettings& settings, GlBackend wanted) {
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
        if (!outcome.blank) return image;
        throw Error(
            ErrorCode::BadData,
            "the picture would be blank: all that is drawn lies outside the view, is smaller than a pixel or "
            "has the background's colour");
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

std::vector<std::string> renderers() {
  std::vector<std::string> names;
  std::string failure;
  for (const GlBackend backend : detail::backends(GlBackend::Automatic)) {
    if (detail::load_gl_module(backend, failure) != nullptr)
      names.emplace_back(detail::backend_name(backend));
  }
  return names;
}

Image render(const Model& model, std::span<const ShellBoundary> boundaries, std::span<const Contour> contours,
             const RenderOptions& options) {
  detail::check(model, boundaries, options);
  detail::GlSettings settings;
  settings.threads = options.threads;
  settings.quick_compile = detail::drawn_triangles(model) <= detail::kQuickTriangles;
  detail::Scene scene = detail::build_scene(model, boundaries, contours, options);
  if (scene.model_batches == 0) {
    throw Error(ErrorCode::BadData, "the picture would be blank: the layers asked for have nothing to draw");
  }
  detail::require_memory(scene, settings.largest_tile);
  return detail::draw(scene, settings, options.backend);
}

}  // namespace meshcontour
