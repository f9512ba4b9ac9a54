// The only file that knows EGL.

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <cstdlib>
#include <string>

#include "render/gl_context.hpp"

namespace meshcontour::detail {
namespace {

[[noreturn]] void fail(const std::string& call) {
  constexpr std::array<const char*, 15> names = {
      "EGL_SUCCESS",       "EGL_NOT_INITIALIZED", "EGL_BAD_ACCESS",        "EGL_BAD_ALLOC",
      "EGL_BAD_ATTRIBUTE", "EGL_BAD_CONFIG",      "EGL_BAD_CONTEXT",       "EGL_BAD_CURRENT_SURFACE",
      "EGL_BAD_DISPLAY",   "EGL_BAD_MATCH",       "EGL_BAD_NATIVE_PIXMAP", "EGL_BAD_NATIVE_WINDOW",
      "EGL_BAD_PARAMETER", "EGL_BAD_SURFACE",     "EGL_CONTEXT_LOST"};
  const auto code = static_cast<std::size_t>(eglGetError() - EGL_SUCCESS);
  throw NoContext(call + ": " + (code < names.size() ? names[code] : "unknown error"));
}

// Without a display server: no surface at all, pictures live in framebuffer objects.
class EglGlContext final : public GlContext {
 public:
  EglGlContext() {
    // The same rasterizer on every machine; a graphics card draws other pixels. The user's own setting stays.
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 0);
    display_ = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display_ == EGL_NO_DISPLAY) fail("eglGetPlatformDisplay (surfaceless)");
    if (eglInitialize(display_, nullptr, nullptr) != EGL_TRUE) fail("eglInitialize");
    try {
      create();
    } catch (...) {
      eglTerminate(display_);
      throw;
    }
  }
  EglGlContext(const EglGlContext&) = delete;
  EglGlContext& operator=(const EglGlContext&) = delete;
  ~EglGlContext() override {
    eglDestroyContext(display_, context_);
    eglTerminate(display_);
  }

  void make_current() override {
    if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE)
      fail("eglMakeCurrent");
  }

  void release() override { eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }

 private:
  void create() {
    if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) fail("eglBindAPI (OpenGL)");
    constexpr std::array<EGLint, 5> wanted = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
                                              EGL_OPENGL_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (eglChooseConfig(display_, wanted.data(), &config, 1, &count) != EGL_TRUE) fail("eglChooseConfig");
    context_ = eglCreateContext(display_, count > 0 ? config : nullptr, EGL_NO_CONTEXT, nullptr);
    if (context_ == EGL_NO_CONTEXT) fail("eglCreateContext (OpenGL)");
  }

  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

std::unique_ptr<GlContext> make_gl_context() {
  return std::make_unique<EglGlContext>();
}

}  // namespace meshcontour::detail
