#pragma once

// An off-screen OpenGL context. One implementation is linked into each module.

#include <memory>
#include <stdexcept>

namespace meshcontour::detail {

/// No context can be made; what() says what was tried.
struct NoContext : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class GlContext {
 public:
  virtual ~GlContext() = default;

  /// Makes the context current in the calling thread. Its own surface is small and of fixed size: pictures
  /// are drawn into framebuffer objects.
  virtual void make_current() = 0;

  /// Leaves the context, so that another thread may take it.
  virtual void release() = 0;
};

/// @throws NoContext  if the system cannot give one.
std::unique_ptr<GlContext> make_gl_context();

}  // namespace meshcontour::detail
