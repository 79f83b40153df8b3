#include "hlod/render/gl_query_source.h"

namespace hlodbench {

void GlQuerySource::issue(NodeId node) {
  if (used_ == queries_.size()) queries_.emplace_back();
  slots_[node] = used_++;
  glBeginQuery(GL_SAMPLES_PASSED, queries_[slots_[node]]);
  renderer_.drawBox(node);
  glEndQuery(GL_SAMPLES_PASSED);
}

bool GlQuerySource::isAvailable(NodeId node) {
  GLuint available = GL_FALSE;
  glGetQueryObjectuiv(queries_[slots_[node]], GL_QUERY_RESULT_AVAILABLE, &available);
  return available == GL_TRUE;
}

std::uint32_t GlQuerySource::getResult(NodeId node) {
  GLuint pixels = 0;
  glGetQueryObjectuiv(queries_[slots_[node]], GL_QUERY_RESULT, &pixels);
  return pixels;
}

}  // namespace hlodbench
