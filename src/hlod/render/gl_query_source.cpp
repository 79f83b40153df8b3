#include "hlod/render/gl_query_source.h"

namespace hlodbench {

void GlQuerySource::issue(NodeId node) {
  std::uint32_t& slot = nodes_[node].slot;
  if (slot == kNoQuery && free_.empty()) {
    slot = static_cast<std::uint32_t>(queries_.size());
    queries_.emplace_back();
  } else if (slot == kNoQuery) {
    slot = free_.back();
    free_.pop_back();
  }
  glBeginQuery(GL_SAMPLES_PASSED, queries_[slot]);
  renderer_.drawBox(node);
  glEndQuery(GL_SAMPLES_PASSED);
}

bool GlQuerySource::isAvailable(NodeId node) {
  if (nodes_[node].slot == kNoQuery) return true;
  GLuint available = GL_FALSE;
  glGetQueryObjectuiv(queries_[nodes_[node].slot], GL_QUERY_RESULT_AVAILABLE, &available);
  return available == GL_TRUE;
}

std::uint32_t GlQuerySource::getResult(NodeId node) {
  NodeQuery& query = nodes_[node];
  if (query.slot != kNoQuery) {
    glGetQueryObjectuiv(queries_[query.slot], GL_QUERY_RESULT, &query.pixels);
    free_.push_back(query.slot);
    query.slot = kNoQuery;
  }
  return query.pixels;
}

}  // namespace hlodbench
