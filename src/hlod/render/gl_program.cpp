#include "hlod/render/gl_program.h"

#include <stdexcept>

#include "hlod/render/gl_debug.h"

namespace hlodbench {
namespace {

void attachShader(GLuint program, GLenum kind, const std::string& label, const char* source) {
  const GLuint shader = glCreateShader(kind);
  glShaderSource(shader, 1, &source, nullptr);
  glCompileShader(shader);
  GLint done = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &done);
  if (!done) {
    char log[2048] = "";
    glGetShaderInfoLog(shader, sizeof log, nullptr, log);
    glDeleteShader(shader);
    throw std::runtime_error("shader '" + label + "' does not compile: " + log);
  }
  glAttachShader(program, shader);
  glDeleteShader(shader);  // lives on with the program
}

}  // namespace

GlProgram makeGlProgram(const std::string& label, const char* vertexSource,
                        const char* fragmentSource) {
  GlProgram program;
  attachShader(program, GL_VERTEX_SHADER, label, vertexSource);
  attachShader(program, GL_FRAGMENT_SHADER, label, fragmentSource);
  glLinkProgram(program);
  GLint done = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &done);
  if (!done) {
    char log[2048] = "";
    glGetProgramInfoLog(program, sizeof log, nullptr, log);
    throw std::runtime_error("program '" + label + "' does not link: " + log);
  }
  labelGlObject(GL_PROGRAM, program, label);
  return program;
}

}  // namespace hlodbench
