#include "hlod/render/gl_fill_buffer.h"

#include <stdexcept>

#include "hlod/render/gl_debug.h"

namespace hlodbench {

void fillBuffer(GLenum target, GLuint buffer, const std::string& label, const void* data,
                std::size_t size, GLenum usage) {
  while (glGetError() != GL_NO_ERROR) {
  }
  glBindBuffer(target, buffer);
  glBufferData(target, static_cast<GLsizeiptr>(size), data, usage);
  if (glGetError() == GL_OUT_OF_MEMORY)
    throw std::runtime_error("no memory for " + std::to_string(size >> 20) + " MiB of " + label);
  labelGlObject(GL_BUFFER, buffer, label);
}

}  // namespace hlodbench
