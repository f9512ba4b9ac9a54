// The only file that knows OSMesa.

#include <GL/osmesa.h>

#include <array>

#include "render/gl_context.hpp"

namespace meshcontour::detail {
namespace {

// Every MakeCurrent with another size leaks a framebuffer in Mesa 22, so the size never changes.
constexpr int kSide = 16;

class OSMesaGlContext final : public GlContext {
 public:
  OSMesaGlContext() {
    constexpr std::array<int, 9> attributes = {OSMESA_FORMAT,
                                               OSMESA_RGBA,
                                               OSMESA_DEPTH_BITS,
                                               24,
                                               OSMESA_PROFILE,
                                               OSMESA_COMPAT_PROFILE,
                                               OSMESA_STENCIL_BITS,
                                               0,
                                               0};
    context_ = OSMesaCreateContextAttribs(attributes.data(), nullptr);
    if (context_ == nullptr) throw NoContext("OSMesaCreateContextAttribs gives no context");
  }
  OSMesaGlContext(const OSMesaGlContext&) = delete;
  OSMesaGlContext& operator=(const OSMesaGlContext&) = delete;
  ~OSMesaGlContext() override { OSMesaDestroyContext(context_); }

  void make_current() override {
    if (OSMesaMakeCurrent(context_, surface_.data(), GL_UNSIGNED_BYTE, kSide, kSide) != GL_TRUE) {
      throw NoContext("OSMesaMakeCurrent fails");
    }
  }

  void release() override { OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }

 private:
  OSMesaContext context_ = nullptr;
  std::array<unsigned char, 4 * kSide * kSide> surface_{};
};

}  // namespace

std::unique_ptr<GlContext> make_gl_context() {
  return std::make_unique<OSMesaGlContext>();
}

}  // namespace meshcontour::detail
