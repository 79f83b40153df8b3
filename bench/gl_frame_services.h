#pragma once

#include <chrono>

#include "hlod/query/query_source.h"
#include "hlod/render/renderer.h"
#include "traversals/frame_services.h"

namespace hlodbench {

// Joins a renderer and a query source to what a strategy asks for, and times its waiting.
class GlFrameServices final : public FrameServices {
 public:
  GlFrameServices(Renderer& renderer, QuerySource& queries)
      : renderer_(renderer), queries_(queries) {}

  void draw(NodeId node) override {
    renderer_.drawNode(node);
    queries_.noteDraw();
  }
  void issueQuery(NodeId node) override { queries_.issue(node); }
  bool isAvailable(NodeId node) override { return queries_.isAvailable(node); }
  std::uint32_t getResult(NodeId node) override {
    const auto start = Clock::now();
    const std::uint32_t pixels = queries_.getResult(node);
    waited_ += Clock::now() - start;
    return pixels;
  }

  // Milliseconds spent in getResult() since the last call.
  double takeWaitMs() {
    const double ms = std::chrono::duration<double, std::milli>(waited_).count();
    waited_ = {};
    return ms;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Renderer& renderer_;
  QuerySource& queries_;
  Clock::duration waited_{};
};

}  // namespace hlodbench
