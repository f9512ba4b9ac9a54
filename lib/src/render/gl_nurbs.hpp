#pragma once

// The only user of GLU: curves to chords through gluNurbsCurve, in tessellator mode. It needs no context,
// calls no OpenGL, and lets one draw call take the chords of every curve.

#include <array>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "render/gl_api.hpp"

namespace meshcontour::detail {

/// gluNurbsCurve has called its error callback, or would have done nothing without calling it.
struct NurbsFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// One GLU renderer, for any number of curves.
class NurbsTessellator {
 public:
  NurbsTessellator();
  NurbsTessellator(const NurbsTessellator&) = delete;
  NurbsTessellator& operator=(const NurbsTessellator&) = delete;
  ~NurbsTessellator();

  /// The chords of a curve, span after span: a strip begins where `starts` says.
  ///
  /// @param knots    order + points of them, not decreasing, no more than `order` alike, distinct ones at
  /// least 1e-4
  ///                 apart (GLU takes knots closer than 1e-5 for one).
  /// @throws NurbsFailure  for a curve that is not finite, has weights that are not positive, or that GLU
  /// refuses.
  void tessellate(const NurbsCurve& curve);

  const std::vector<std::array<float, 3>>& points() const { return points_; }
  const std::vector<std::size_t>& starts() const { return starts_; }

 private:
  struct Callbacks;
  struct Renderer;

  std::unique_ptr<Renderer> renderer_;
  std::vector<std::array<float, 3>> points_;
  std::vector<std::size_t> starts_;
  bool rational_ = false;
  float samples_ = 0;
};

}  // namespace meshcontour::detail
