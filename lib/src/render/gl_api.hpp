#pragma once

// The seam between the library and the modules that draw. A module is a shared library of its own, so that a
// run that makes no picture never maps a rasterizer.

#include <span>
#include <string>
#include <vector>

#include "meshcontour/render.hpp"
#include "render/scene.hpp"

namespace meshcontour::detail {

/// Changes whenever this file, scene.hpp or Image does; a module of another version is refused.
inline constexpr int kGlApiVersion = 5;

/// The one symbol that a module exports, a `const GlApi* ()` with C linkage.
inline constexpr const char* kGlApiSymbol = "meshcontour_gl_api";

/// How a call into a module ended. Exceptions do not cross the seam.
struct GlOutcome {
  enum class Status { Done, NoContext, OutOfMemory, Failed };

  Status status = Status::Done;
  std::string message;
  bool blank = false;  ///< every sample has the background's colour
};

struct GlSettings {
  bool quick_compile = true;  ///< the scene is small: compiling shaders costs more than running them
  unsigned threads = 0;       ///< of the rasterizer; 0: its own choice
  int largest_tile = 8192;    ///< samples; larger pictures are drawn in parts
};

/// A curve as gluNurbsCurve takes it.
struct NurbsCurve {
  int order = 4;
  bool rational = false;
  std::span<const float> knots;
  std::span<const float> control;  ///< 3 floats a point, or 4 (w x, w y, w z, w)
  float samples = 1;               ///< chords a unit of the parameter, at least
};

/// The chords of one knot span.
using NurbsStrip = std::vector<std::array<float, 3>>;

struct GlApi {
  int version;

  /// Makes the context on first use, draws the scene and reads it back. Chords of curves are appended to the
  /// scene's vertices: once drawn, it is used up.
  GlOutcome (*draw)(Scene& scene, const GlSettings& settings, Image& image);

  /// What gluNurbsCurve makes of a curve, one strip a knot span. Needs no context.
  GlOutcome (*tessellate)(const NurbsCurve& curve, std::vector<NurbsStrip>& strips);
};

}  // namespace meshcontour::detail
