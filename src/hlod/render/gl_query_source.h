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
      : renderer_(renderer), slots_(nodeCount, 0) {}

  void beginFrame() override { used_ = 0; }
  void issue(NodeId node) override;
  bool isAvailable(NodeId node) override;
  std::uint32_t getResult(NodeId node) override;

 private:
  Renderer& renderer_;
  std::vector<GlQuery> queries_;      // reused from frame to frame
  std::vector<std::uint32_t> slots_;  // one a node: its query of this frame
  std::uint32_t used_ = 0;
};

}  // namespace hlodbench
