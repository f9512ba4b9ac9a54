#pragma once

// The only user of OpenGL: a scene into an image, through framebuffer objects of our own.

#include "render/gl_api.hpp"
#include "render/gl_nurbs.hpp"

namespace meshcontour::detail {

/// OpenGL has run out of memory.
struct GlOutOfMemory : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// OpenGL reports an error that should not be, or what is read back is not what was drawn.
struct GlFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Checks that the current context draws: its name is known and a cleared pixel reads back.
///
/// @throws GlFailure
void test_context();

/// Draws all samples, in tiles where they are more than `largest_tile` in a row, and averages.
///
/// @return false if every sample has the background's colour.
/// @throws GlOutOfMemory, GlFailure, NurbsFailure
bool draw_scene(Scene& scene, int largest_tile, NurbsTessellator& tessellator, Image& image);

}  // namespace meshcontour::detail
