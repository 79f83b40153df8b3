#pragma once

#include <glad/gl.h>

#include <string>

namespace hlodbench {

// Prints every GL message of medium severity or above to stderr, synchronously, and ends the
// program on a GL error. Does nothing without KHR_debug.
void enableGlDebugOutput();

// Names an object for debuggers (RenderDoc, apitrace, Nsight).
void labelGlObject(GLenum kind, GLuint object, const std::string& label);

// A named group of commands for debuggers, as long as the object lives.
class GlDebugGroup {
 public:
  explicit GlDebugGroup(const char* name) {
    if (GLAD_GL_KHR_debug) glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, -1, name);
  }
  ~GlDebugGroup() {
    if (GLAD_GL_KHR_debug) glPopDebugGroup();
  }
  GlDebugGroup(const GlDebugGroup&) = delete;
  GlDebugGroup& operator=(const GlDebugGroup&) = delete;
};

}  // namespace hlodbench
