#include "render/gl_nurbs.hpp"

#include <GL/glu.h>

#include <algorithm>
#include <cmath>

namespace meshcontour::detail {
namespace {

constexpr int kMaxOrder = 24;  // GLU's own; GL_MAX_EVAL_ORDER reports another number

// GLU_ERROR is the one callback that is not told whose it is.
thread_local GLenum first_error = 0;

bool finite(std::span<const float> values) {
  return std::ranges::all_of(values, [](float value) { return std::isfinite(value); });
}

// What GLU does not check, or answers with an abort when it is built with assertions.
void require_well_formed(const NurbsCurve& curve) {
  const std::size_t stride = curve.rational ? 4 : 3;
  const std::size_t count = curve.control.size() / stride;
  const auto order = static_cast<std::size_t>(curve.order);
  if (curve.order < 2 || curve.order > kMaxOrder) throw NurbsFailure("the order is not in 2..24");
  if (count * stride != curve.control.size() || count < order || curve.knots.size() != count + order) {
    throw NurbsFailure("the numbers of knots and control points do not match");
  }
  if (!finite(curve.knots) || !finite(curve.control))
    throw NurbsFailure("a knot or control point is not finite");
  if (!std::ranges::is_sorted(curve.knots)) throw NurbsFailure("the knots decrease");
  for (std::size_t i = 0; i + order < curve.knots.size(); ++i) {
    if (i > 0 && i + order + 1 < curve.knots.size() && curve.knots[i] == curve.knots[i + order]) {
      throw NurbsFailure("a knot is repeated more often than the order");
    }
  }
  for (std::size_t i = 3; curve.rational && i < curve.control.size(); i += 4) {
    if (!(curve.control[i] > 0)) throw NurbsFailure("a weight is not positive");
  }
}

}  // namespace

struct NurbsTessellator::Renderer {
  Renderer() : nurbs(gluNewNurbsRenderer()) {
    if (nurbs == nullptr) throw std::bad_alloc();
  }
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;
  ~Renderer() { gluDeleteNurbsRenderer(nurbs); }

  GLUnurbs* nurbs;
};

struct NurbsTessellator::Callbacks {
  static void begin(GLenum, void* self) {
    auto& tessellator = *static_cast<NurbsTessellator*>(self);
    tessellator.starts_.push_back(tessellator.points_.size());
  }

  static void vertex(GLfloat* v, void* self) {
    auto& tessellator = *static_cast<NurbsTessellator*>(self);
    const float w = tessellator.rational_ ? v[3] : 1.0F;
    tessellator.points_.push_back({v[0] / w, v[1] / w, v[2] / w});
  }

  static void error(GLenum code) { first_error = first_error == 0 ? code : first_error; }

  template <typename Function>
  static void install(GLUnurbs* nurbs, GLenum which, Function* function) {
    gluNurbsCallback(nurbs, which, reinterpret_cast<_GLUfuncptr>(function));
  }
};

NurbsTessellator::NurbsTessellator() : renderer_(std::make_unique<Renderer>()) {
  GLUnurbs* nurbs = renderer_->nurbs;
  gluNurbsProperty(nurbs, GLU_NURBS_MODE, GLU_NURBS_TESSELLATOR);
  gluNurbsProperty(nurbs, GLU_AUTO_LOAD_MATRIX, GL_FALSE);
  gluNurbsProperty(nurbs, GLU_CULLING, GL_FALSE);
  gluNurbsProperty(nurbs, GLU_SAMPLING_METHOD, GLU_DOMAIN_DISTANCE);
  constexpr std::array<GLfloat, 16> identity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  constexpr std::array<GLint, 4> viewport = {0, 0, 1, 1};
  gluLoadSamplingMatrices(nurbs, identity.data(), identity.data(), viewport.data());
  Callbacks::install(nurbs, GLU_NURBS_BEGIN_DATA, &Callbacks::begin);
  Callbacks::install(nurbs, GLU_NURBS_VERTEX_DATA, &Callbacks::vertex);
  Callbacks::install(nurbs, GLU_NURBS_ERROR, &Callbacks::error);
  gluNurbsCallbackData(nurbs, this);
}

NurbsTessellator::~NurbsTessellator() = default;

void NurbsTessellator::tessellate(const NurbsCurve& curve) {
  require_well_formed(curve);
  points_.clear();
  starts_.clear();
  rational_ = curve.rational;
  first_error = 0;
  GLUnurbs* nurbs = renderer_->nurbs;
  if (curve.samples != samples_) gluNurbsProperty(nurbs, GLU_U_STEP, samples_ = curve.samples);
  // GLU takes pointers to its input that are not const, and does not write through them.
  gluBeginCurve(nurbs);
  gluNurbsCurve(nurbs, static_cast<GLint>(curve.knots.size()), const_cast<GLfloat*>(curve.knots.data()),
                curve.rational ? 4 : 3, const_cast<GLfloat*>(curve.control.data()), curve.order,
                curve.rational ? GL_MAP1_VERTEX_4 : GL_MAP1_VERTEX_3);
  gluEndCurve(nurbs);
  if (first_error != 0) {
    const auto* text = reinterpret_cast<const char*>(gluErrorString(first_error));
    throw NurbsFailure("gluNurbsCurve: " +
                       (text != nullptr ? std::string(text) : std::to_string(first_error)));
  }
  if (starts_.empty()) throw NurbsFailure("gluNurbsCurve gives no points");
}

}  // namespace meshcontour::detail
