#pragma once

#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>

namespace meshcontour::detail {

/// A framebuffer object with 8 bits a channel and 24 bits of depth, bound when made.
class Framebuffer {
 public:
  /// @throws GlOutOfMemory, GlFailure  if it is not complete.
  Framebuffer(int width, int height);
  Framebuffer(const Framebuffer&) = delete;
  Framebuffer& operator=(const Framebuffer&) = delete;
  ~Framebuffer();

  int width() const { return width_; }
  int height() const { return height_; }
  void bind() const { glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_); }

 private:
  void destroy();

  int width_, height_;
  GLuint framebuffer_ = 0, color_ = 0, depth_ = 0;
};

/// @throws GlOutOfMemory, GlFailure  if glGetError reports anything; `what` was being done.
void check_gl(const char* what);

}  // namespace meshcontour::detail
