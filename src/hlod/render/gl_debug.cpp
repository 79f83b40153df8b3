#include "hlod/render/gl_debug.h"

#include <cstdio>
#include <cstdlib>

namespace hlodbench {
namespace {

void GLAD_API_PTR onMessage(GLenum source, GLenum type, GLuint /*id*/, GLenum severity,
                            GLsizei /*length*/, const GLchar* message, const void* /*user*/) {
  if (source == GL_DEBUG_SOURCE_APPLICATION) return;  // our own groups
  if (severity != GL_DEBUG_SEVERITY_HIGH && severity != GL_DEBUG_SEVERITY_MEDIUM &&
      type != GL_DEBUG_TYPE_ERROR)
    return;
  std::fprintf(stderr, "OpenGL: %s\n", message);
  if (type == GL_DEBUG_TYPE_ERROR) std::abort();
}

}  // namespace

void enableGlDebugOutput() {
  if (!GLAD_GL_KHR_debug) return;
  glEnable(GL_DEBUG_OUTPUT);
  glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  glDebugMessageCallback(onMessage, nullptr);
}

void labelGlObject(GLenum kind, GLuint object, const std::string& label) {
  if (GLAD_GL_KHR_debug) glObjectLabel(kind, object, -1, label.c_str());
}

}  // namespace hlodbench
