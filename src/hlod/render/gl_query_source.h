#pragma once

#include <vector>

#include "hlod/query/query_source.h"
#include "hlod/render/gl_object.h"
#include "hlod/render/renderer.h"

namespace hlodbench {

// Hardware occlusion queries (GL_SAMPLES_PASSED) with the driver's own asynchronous availability.
class GlQuerySource final : public QuerySource {
 public:
  GlQuerySource(Renderer& renderer, std::size_t nodeCount)
      : renderer_(renderer), nodes_(nodeCount) {}

  void issue(NodeId node) override;
  bool isAvailable(NodeId node) override;
  std::uint32_t getResult(NodeId node) override;

 private:
  static constexpr std::uint32_t kNoQuery = 0xffffffff;
  struct NodeQuery {
    std::uint32_t slot = kNoQuery;  // in queries_, while the result has not been read
    std::uint32_t pixels = 0;       // the result, when it has
  };

  Renderer& renderer_;
  std::vector<GlQuery> queries_;     // reused as soon as a result was read
  std::vector<std::uint32_t> free_;  // slots
  std::vector<NodeQuery> nodes_;     // one a node
};

}  // namespace hlodbench
