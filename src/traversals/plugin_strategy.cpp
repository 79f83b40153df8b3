#include "traversals/plugin_strategy.h"

#include <fmt/format.h>

#include <stdexcept>
#include <vector>

#include "traversals/coherent_traversal.h"
#include "traversals/scene_view.h"

namespace hlodbench {
namespace {

// A frame of a whole strategy: passes on what is allowed, counts it, keeps the nodes' states.
class CheckedFrame final : public plugin::Frame {
 public:
  CheckedFrame(const Hierarchy& hierarchy, const TraversalOptions& options, Modulation modulation)
      : scene_(hierarchy, options), modulation_(modulation), queried_(hierarchy.nodes.size()) {}

  const plugin::FrameView& begin(const Camera& camera, FrameServices& services, Trace* trace) {
    scene_.beginFrame(camera);
    services_ = &services;
    trace_ = trace;
    drawnInLastFrame_ = static_cast<int>(drawn_.size());
    drawn_.clear();
    wrong_.clear();
    queries_ = visited_ = delays_ = delayedDrawn_ = drawnAgain_ = 0;
    triangles_ = 0;
    return scene_.frame();
  }

  void end(FrameRecord& record) {
    // an exception that the strategy caught
    if (!wrong_.empty()) throw std::logic_error(wrong_);
    record.set(Counter::kDn, static_cast<double>(drawn_.size()));
    if (frame() > 0)
      record.set(Counter::kFrontChange,
                 static_cast<int>(drawn_.size()) + drawnInLastFrame_ - 2 * drawnAgain_);
    record.set(Counter::kRarn, countRefined());
    record.set(Counter::kQueries, queries_);
    record.set(Counter::kTriangles, static_cast<double>(triangles_));
    if (hasDelays_) record.set(Counter::kDelays, delays_);
    if (hasDelays_) record.set(Counter::kD, delayedDrawn_);
    if (hasVisits_) record.set(Counter::kNodesVisited, visited_);
  }

  void draw(NodeId node) override {
    NodeState& s = takeUp(node, "draw");
    if (s.lastRendered == frame()) fail(fmt::format("drew node {} twice", node));
    if (s.lastRendered == frame() - 1) ++drawnAgain_;
    s.lastRendered = frame();
    s.stopRefinement = true;
    if (s.delayed) ++delayedDrawn_;
    triangles_ += scene_.frame().node(node).triangleCount;
    drawn_.push_back(node);
    note({TraceEvent::Type::kDraw, node});
    services_->draw(node);
  }

  void issueQuery(NodeId node) override {
    takeUp(node, "query");
    if (queried_[node].frame == frame()) fail(fmt::format("queried node {} twice", node));
    queried_[node] = {frame(), scene_.computeBoxPixels(node)};
    ++queries_;
    note({TraceEvent::Type::kQuery, node});
    services_->issueQuery(node);
  }

  bool isAvailable(NodeId node) override {
    checkQueried(node);
    return services_->isAvailable(node);
  }

  std::uint32_t getResult(NodeId node) override {
    checkQueried(node);
    const std::uint32_t pixels = services_->getResult(node);
    const double boxPixels = queried_[node].boxPixels;
    scene_.storePixels(node, pixels, boxPixels);
    NodeState& s = scene_.state(node);
    s.bias = modulation_ == Modulation::kBias ? scene_.frame().computeBias(s.mu) : 1.0;
    s.visible = pixels > 0;
    note({.type = TraceEvent::Type::kResult,
          .node = node,
          .pixels = pixels,
          .boxPixels = boxPixels,
          .mu = s.mu,
          .bias = s.bias,
          .stop = s.stopRefinement});
    return pixels;
  }

  void noteVisit(NodeId node) override {
    takeUp(node, "visit");
    hasVisits_ = true;
    ++visited_;
  }

  void noteDelay(NodeId node) override {
    takeUp(node, "delay").delayed = true;
    hasDelays_ = true;
    ++delays_;
  }

 private:
  struct Query {
    int frame = -1;          // the last in which the node was queried
    double boxPixels = 1.0;  // that its box covered then
  };

  [[nodiscard]] int frame() const { return scene_.frame().frame(); }

  [[noreturn]] void fail(std::string what) {
    wrong_ = std::move(what);
    throw std::logic_error(wrong_);
  }

  void checkExists(NodeId node, const char* what) {
    if (node >= scene_.frame().nodeCount())
      fail(fmt::format("asked to {} node {}; the hierarchy has {} nodes", what, node,
                       scene_.frame().nodeCount()));
  }

  void checkQueried(NodeId node) {
    checkExists(node, "get the result of");
    if (queried_[node].frame < 0)
      fail(fmt::format("asked for the result of node {}, which was not queried", node));
  }

  // The state of a node that is met in this frame.
  NodeState& takeUp(NodeId node, const char* what) {
    checkExists(node, what);
    NodeState& s = scene_.state(node);
    if (s.lastVisited != frame()) {
      s.lastVisited = frame();
      s.visible = s.stopRefinement = s.delayed = false;
    }
    return s;
  }

  // Nodes drawn before one below them: rendered, then refined.
  int countRefined() {
    order_.resize(scene_.frame().nodeCount(), 0);
    for (std::size_t i = 0; i < drawn_.size(); ++i) order_[drawn_[i]] = i + 1;
    int count = 0;
    for (const NodeId node : drawn_)
      for (NodeId above = parentOf(node); above != kNoNode; above = parentOf(above)) {
        // not drawn, drawn later, or counted already
        if (order_[above] == 0 || order_[above] > order_[node] ||
            !scene_.state(above).stopRefinement)
          continue;
        scene_.state(above).stopRefinement = false;
        ++count;
        note({TraceEvent::Type::kRarn, above});
      }
    for (const NodeId node : drawn_) order_[node] = 0;
    return count;
  }

  [[nodiscard]] NodeId parentOf(NodeId node) const { return scene_.frame().node(node).parent; }

  void note(const TraceEvent& event) {
    if (trace_ != nullptr) trace_->push_back(event);
  }

  SceneView scene_;
  Modulation modulation_;
  std::vector<Query> queried_;      // by node
  std::vector<NodeId> drawn_;       // in this frame, in order
  std::vector<std::size_t> order_;  // of each node in drawn_, from 1; 0 between frames
  std::string wrong_;               // what was ruled out in this frame, if anything
  FrameServices* services_ = nullptr;
  Trace* trace_ = nullptr;
  int queries_ = 0, visited_ = 0, delays_ = 0, delayedDrawn_ = 0;
  int drawnAgain_ = 0;  // of drawn_: in the last frame, too
  int drawnInLastFrame_ = 0;
  std::uint64_t triangles_ = 0;
  bool hasVisits_ = false, hasDelays_ = false;  // in any frame so far
};

class PluginStrategy final : public Strategy {
 public:
  PluginStrategy(const StrategyInputs& inputs, Modulation modulation,
                 std::unique_ptr<plugin::Strategy> strategy)
      : frame_(inputs.hierarchy, inputs.options, modulation), strategy_(std::move(strategy)) {}

  void renderFrame(const Camera& camera, FrameServices& services, FrameRecord& record,
                   Trace* trace) override {
    strategy_->renderFrame(frame_.begin(camera, services, trace), frame_);
    frame_.end(record);
  }

 private:
  CheckedFrame frame_;
  std::unique_ptr<plugin::Strategy> strategy_;
};

}  // namespace

std::unique_ptr<Strategy> makePluginStrategy(const plugin::StrategyDescriptor& descriptor,
                                             const StrategyInputs& inputs) {
  if (descriptor.makePredictor != nullptr)
    return std::make_unique<CoherentTraversal>(
        inputs.hierarchy, inputs.options, descriptor.modulation,
        std::unique_ptr<Predictor>(descriptor.makePredictor(inputs.own)));
  return std::make_unique<PluginStrategy>(
      inputs, descriptor.modulation,
      std::unique_ptr<plugin::Strategy>(descriptor.makeStrategy(inputs.own)));
}

}  // namespace hlodbench
