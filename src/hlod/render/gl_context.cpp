#include "hlod/render/gl_context.h"

#include <fmt/format.h>
#include <glad/gl.h>

#include <array>

#include "hlod/core/error.h"
#include "hlod/render/driver_memory.h"
#include "hlod/render/gl_context_kinds.h"
#include "hlod/render/gl_debug.h"

namespace hlodbench {
namespace {

constexpr std::array kContexts {
  GlContextInfo{"egl", "EGL: a GPU device first, then Mesa's surfaceless software rasteriser",
                makeEglContext},
#if HLODBENCH_HAVE_OSMESA
      GlContextInfo{"osmesa", "OSMesa: Mesa's software rasteriser, without EGL (not in Mesa 25.1+)",
                    makeOsMesaContext},
#endif
};

std::string getGlString(GLenum name) {
  const auto* text = reinterpret_cast<const char*>(glGetString(name));
  return text != nullptr ? text : "";
}

std::unique_ptr<GlContext> make(const GlContextInfo& info, const GlContextOptions& options) {
  keepDriverMemory();
  std::unique_ptr<GlContext> context = info.make(options);
  completeContext(*context, info.name, options);
  return context;
}

}  // namespace

void completeContext(GlContext& context, std::string_view name, const GlContextOptions& options) {
  context.name = name;
  context.vendor = getGlString(GL_VENDOR);
  context.renderer = getGlString(GL_RENDERER);
  context.version = getGlString(GL_VERSION);
  if (!GLAD_GL_VERSION_3_3)
    throw GlUnavailable(
        fmt::format("{}: expected OpenGL 3.3 core or later, found {}", name, context.version));
  if (options.debug) enableGlDebugOutput();
}

std::span<const GlContextInfo> listContexts() {
  return kContexts;
}

std::unique_ptr<GlContext> createContext(std::string_view name, const GlContextOptions& options) {
  std::string known = "auto";
  for (const GlContextInfo& info : kContexts) {
    if (info.name == name) return make(info, options);
    known += ", " + std::string(info.name);
  }
  if (name != "auto")
    throw InputError(fmt::format("--context: expected one of {}, found '{}'", known, name));
  std::vector<std::string> tried;
  for (const GlContextInfo& info : kContexts) {
    try {
      std::unique_ptr<GlContext> context = make(info, options);
      context->tried.insert(context->tried.begin(), tried.begin(), tried.end());
      return context;
    } catch (const GlUnavailable& error) {
      tried.emplace_back(error.what());
    }
  }
  std::string message = "no usable OpenGL context; tried";
  for (const std::string& line : tried) message += " [" + line + "]";
  throw GlUnavailable(message);
}

}  // namespace hlodbench
