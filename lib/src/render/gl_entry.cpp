// The module's door: one table of functions, and nothing thrown through it.

#include <cstdlib>
#include <new>

#include "render/gl_context.hpp"
#include "render/gl_draw.hpp"

namespace meshcontour::detail {
namespace {

// llvmpipe reads these once, when the first context is made; the user's own setting stays.
void prepare_environment(const GlSettings& settings) {
  if (settings.quick_compile) setenv("GALLIVM_PERF", "nopt", 0);
  if (settings.threads > 0) setenv("LP_NUM_THREADS", std::to_string(settings.threads).c_str(), 0);
}

// The process's one context: making it costs more than a picture. Never destroyed, for at exit the
// rasterizer's own statics may be gone before ours.
GlContext& context(const GlSettings& settings) {
  static GlContext* const only = [&] {
    prepare_environment(settings);
    return make_gl_context().release();
  }();
  return *only;
}

class Current {
 public:
  explicit Current(GlContext& context) : context_(context) { context_.make_current(); }
  Current(const Current&) = delete;
  Current& operator=(const Current&) = delete;
  ~Current() { context_.release(); }

 private:
  GlContext& context_;
};

template <typename Work>
GlOutcome guarded(const Work& work) {
  using Status = GlOutcome::Status;
  try {
    work();
    return {};
  } catch (const NoContext& error) {
    return {Status::NoContext, error.what()};
  } catch (const GlOutOfMemory& error) {
    return {Status::OutOfMemory, error.what()};
  } catch (const std::bad_alloc&) {
    return {Status::OutOfMemory, "not enough memory for the picture"};
  } catch (const std::exception& error) {
    return {Status::Failed, error.what()};
  }
}

GlOutcome draw(Scene& scene, const GlSettings& settings, Image& image) {
  bool something = false;
  GlOutcome outcome = guarded([&] {
    const Current current(context(settings));
    try {
      test_context();
    } catch (const GlFailure& failure) {
      throw NoContext(failure.what());
    }
    NurbsTessellator tessellator;
    something = draw_scene(scene, settings.largest_tile, tessellator, image);
  });
  outcome.blank = !something;
  return outcome;
}

GlOutcome tessellate(const NurbsCurve& curve, std::vector<NurbsStrip>& strips) {
  return guarded([&] {
    NurbsTessellator tessellator;
    tessellator.tessellate(curve);
    const auto& points = tessellator.points();
    const auto& starts = tessellator.starts();
    strips.clear();
    for (std::size_t i = 0; i < starts.size(); ++i) {
      const std::size_t end = i + 1 < starts.size() ? starts[i + 1] : points.size();
      strips.emplace_back(points.begin() + static_cast<std::ptrdiff_t>(starts[i]),
                          points.begin() + static_cast<std::ptrdiff_t>(end));
    }
  });
}

}  // namespace
}  // namespace meshcontour::detail

extern "C" __attribute__((visibility("default"))) const void* meshcontour_gl_api() {
  static const meshcontour::detail::GlApi api = {
      meshcontour::detail::kGlApiVersion, &meshcontour::detail::draw, &meshcontour::detail::tessellate};
  return &api;
}
