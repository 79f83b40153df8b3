// Off-screen OpenGL through OSMesa, Mesa's in-memory software renderer.
#if HLODBENCH_HAVE_OSMESA
#include <glad/gl.h>

#include <GL/osmesa.h>

#include "hlod/render/gl_context_kinds.h"
#include "hlod/render/shared_library.h"

namespace hlodbench {
namespace {

constexpr const char* kPackage = "libosmesa6";

struct OsMesa {
  SharedLibrary library;
  decltype(&OSMesaCreateContextAttribs) createContext =
      library.get<decltype(&OSMesaCreateContextAttribs)>("OSMesaCreateContextAttribs");
  decltype(&OSMesaDestroyContext) destroyContext =
      library.get<decltype(&OSMesaDestroyContext)>("OSMesaDestroyContext");
  decltype(&OSMesaMakeCurrent) makeCurrent =
      library.get<decltype(&OSMesaMakeCurrent)>("OSMesaMakeCurrent");
  decltype(&OSMesaGetProcAddress) getProcAddress =
      library.get<decltype(&OSMesaGetProcAddress)>("OSMesaGetProcAddress");
};

class OsMesaContext final : public GlContext {
 public:
  OsMesaContext() : api_{SharedLibrary("libOSMesa.so.8", kPackage)} {
    constexpr int kVersions[][2] = {{4, 5}, {3, 3}};
    for (const auto& wanted : kVersions) {
      const int attributes[] = {OSMESA_FORMAT,
                                OSMESA_RGBA,
                                OSMESA_PROFILE,
                                OSMESA_CORE_PROFILE,
                                OSMESA_CONTEXT_MAJOR_VERSION,
                                wanted[0],
                                OSMESA_CONTEXT_MINOR_VERSION,
                                wanted[1],
                                0};
      context_ = api_.createContext(attributes, nullptr);
      if (context_ != nullptr) break;
    }
    if (context_ == nullptr)
      throw GlUnavailable("osmesa: no OpenGL 3.3 core context; Debian package: libosmesa6");
    // OSMesa wants a buffer to make a context current; everything is drawn elsewhere
    if (!api_.makeCurrent(context_, pixels_, GL_UNSIGNED_BYTE, kSize, kSize) ||
        gladLoadGL(reinterpret_cast<GLADloadfunc>(api_.getProcAddress)) == 0) {
      api_.destroyContext(context_);
      throw GlUnavailable("osmesa: the context cannot be made current");
    }
    detail = "OSMesa off-screen software rendering";
  }
  ~OsMesaContext() override {
    api_.makeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
    api_.destroyContext(context_);
  }

 private:
  static constexpr int kSize = 4;
  OsMesa api_;
  OSMesaContext context_ = nullptr;
  unsigned char pixels_[kSize * kSize * 4]{};
};

}  // namespace

std::unique_ptr<GlContext> makeOsMesaContext(const GlContextOptions& /*options*/) {
  return std::make_unique<OsMesaContext>();
}

}  // namespace hlodbench
#endif
