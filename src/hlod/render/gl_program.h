#pragma once

#include <string>

#include "hlod/render/gl_object.h"

namespace hlodbench {

// Compiles and links a program; throws std::runtime_error with the driver's log.
GlProgram makeGlProgram(const std::string& label, const char* vertexSource,
                        const char* fragmentSource);

}  // namespace hlodbench
