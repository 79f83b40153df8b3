#pragma once

#include <cstddef>
#include <string>

#include "hlod/render/gl_object.h"

namespace hlodbench {

// Binds the buffer and gives it `size` bytes, uninitialised where data is null. Throws
// std::runtime_error when the driver has no memory for it.
void fillBuffer(GLenum target, GLuint buffer, const std::string& label, const void* data,
                std::size_t size, GLenum usage = GL_STATIC_DRAW);

}  // namespace hlodbench
