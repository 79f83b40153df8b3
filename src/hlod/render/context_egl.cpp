// Off-screen OpenGL through EGL: a GPU's device if there is one, else Mesa's surfaceless platform.
#include <glad/gl.h>

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <fmt/format.h>

#include <cstring>

#include "hlod/render/gl_context_kinds.h"
#include "hlod/render/shared_library.h"

namespace hlodbench {
namespace {

constexpr const char* kPackages = "libegl1, with the drivers of libegl-mesa0 and libgl1-mesa-dri";

// The functions of EGL that are used, loaded from the library found at run time.
struct Egl {
  SharedLibrary library{"libEGL.so.1", kPackages};
  decltype(&eglGetProcAddress) getProcAddress =
      library.get<decltype(&eglGetProcAddress)>("eglGetProcAddress");
  decltype(&eglGetError) getError = library.get<decltype(&eglGetError)>("eglGetError");
  decltype(&eglInitialize) initialize = library.get<decltype(&eglInitialize)>("eglInitialize");
  decltype(&eglTerminate) terminate = library.get<decltype(&eglTerminate)>("eglTerminate");
  decltype(&eglBindAPI) bindApi = library.get<decltype(&eglBindAPI)>("eglBindAPI");
  decltype(&eglCreateContext) createContext =
      library.get<decltype(&eglCreateContext)>("eglCreateContext");
  decltype(&eglDestroyContext) destroyContext =
      library.get<decltype(&eglDestroyContext)>("eglDestroyContext");
  decltype(&eglMakeCurrent) makeCurrent = library.get<decltype(&eglMakeCurrent)>("eglMakeCurrent");
  decltype(&eglQueryString) queryString = library.get<decltype(&eglQueryString)>("eglQueryString");

  template <typename Function>
  Function getExtension(const char* name) const {
    return reinterpret_cast<Function>(getProcAddress(name));
  }
};

class EglContext final : public GlContext {
 public:
  EglContext(Egl egl, EGLDisplay display, EGLContext context)
      : egl_(std::move(egl)), display_(display), context_(context) {}
  ~EglContext() override {
    egl_.makeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    egl_.destroyContext(display_, context_);
    egl_.terminate(display_);
  }

 private:
  Egl egl_;
  EGLDisplay display_;
  EGLContext context_;
};

// One way to a display: what it is called in messages, and the handle.
struct Candidate {
  std::string label;
  EGLDisplay display;
};

std::vector<Candidate> listCandidates(const Egl& egl) {
  std::vector<Candidate> candidates;
  const auto getPlatformDisplay =
      egl.getExtension<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  if (getPlatformDisplay == nullptr) return candidates;
  const auto queryDevices = egl.getExtension<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
  const auto queryDevice =
      egl.getExtension<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
  EGLDeviceEXT devices[32];
  EGLint count = 0;
  if (queryDevices != nullptr && queryDevice != nullptr && queryDevices(32, devices, &count)) {
    for (EGLint i = 0; i < count; ++i) {
      const char* extensions = queryDevice(devices[i], EGL_EXTENSIONS);
      // Mesa's software device gives no vendor string: only this extension tells it from a GPU
      if (extensions != nullptr && std::strstr(extensions, "EGL_MESA_device_software") != nullptr)
        continue;
      candidates.push_back({fmt::format("EGL device {} (GPU)", i),
                            getPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr)});
    }
  }
  candidates.push_back(
      {"EGL surfaceless platform",
       getPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr)});
  return candidates;
}

// Returns null and the reason when this display gives no context.
EGLContext tryDisplay(const Egl& egl, EGLDisplay display, bool debug, std::string& reason) {
  if (display == EGL_NO_DISPLAY || !egl.initialize(display, nullptr, nullptr)) {
    reason = fmt::format("no display (EGL error {:#x})", egl.getError());
    return nullptr;
  }
  egl.bindApi(EGL_OPENGL_API);
  constexpr EGLint kVersions[][2] = {{4, 5}, {3, 3}};
  for (const auto& version : kVersions) {
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                 version[0],
                                 EGL_CONTEXT_MINOR_VERSION,
                                 version[1],
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                 EGL_CONTEXT_OPENGL_DEBUG,
                                 debug ? EGL_TRUE : EGL_FALSE,
                                 EGL_NONE};
    EGLContext context = egl.createContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
    if (context == EGL_NO_CONTEXT) continue;
    if (egl.makeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) &&
        gladLoadGL(reinterpret_cast<GLADloadfunc>(egl.getProcAddress)) != 0)
      return context;
    egl.destroyContext(display, context);
  }
  reason = fmt::format("no OpenGL 3.3 core context (EGL error {:#x})", egl.getError());
  egl.terminate(display);
  return nullptr;
}

}  // namespace

std::unique_ptr<GlContext> makeEglContext(const GlContextOptions& options) {
  Egl egl;
  std::vector<std::string> tried;
  for (const Candidate& candidate : listCandidates(egl)) {
    std::string reason;
    if (EGLContext context = tryDisplay(egl, candidate.display, options.debug, reason)) {
      auto result = std::make_unique<EglContext>(std::move(egl), candidate.display, context);
      result->detail = candidate.label;
      if (tried.empty() && candidate.label.find("GPU") == std::string::npos)
        tried.emplace_back("EGL devices: none is a GPU");
      result->tried = std::move(tried);
      return result;
    }
    tried.push_back(candidate.label + ": " + reason);
  }
  std::string message = "egl: ";
  for (const std::string& line : tried) message += line + "; ";
  throw GlUnavailable(message + "Debian packages: " + kPackages);
}

}  // namespace hlodbench
