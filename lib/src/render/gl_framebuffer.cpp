#include "render/gl_framebuffer.hpp"

#include <string>

#include "render/gl_draw.hpp"

namespace meshcontour::detail {

void check_gl(const char* what) {
  const GLenum error = glGetError();
  if (error == GL_NO_ERROR) return;
  // One call after another reports the flags that are left; a bound, because without a context it never ends.
  for (int i = 0; i < 16 && glGetError() != GL_NO_ERROR; ++i) {
  }
  if (error == GL_OUT_OF_MEMORY) throw GlOutOfMemory(std::string("OpenGL is out of memory: ") + what);
  throw GlFailure(std::string("OpenGL error ") + std::to_string(error) + ": " + what);
}

Framebuffer::Framebuffer(int width, int height) : width_(width), height_(height) {
  glGenFramebuffers(1, &framebuffer_);
  glGenRenderbuffers(1, &color_);
  glGenRenderbuffers(1, &depth_);
  glBindRenderbuffer(GL_RENDERBUFFER, color_);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width, height);
  glBindRenderbuffer(GL_RENDERBUFFER, depth_);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, width, height);
  bind();
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color_);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_);
  try {
    check_gl("making a framebuffer");
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
      throw GlFailure("OpenGL gives no complete framebuffer");
    }
  } catch (...) {
    destroy();
    throw;
  }
}

Framebuffer::~Framebuffer() {
  destroy();
}

void Framebuffer::destroy() {
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glDeleteFramebuffers(1, &framebuffer_);
  glDeleteRenderbuffers(1, &color_);
  glDeleteRenderbuffers(1, &depth_);
}

}  // namespace meshcontour::detail
