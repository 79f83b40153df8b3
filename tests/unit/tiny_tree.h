#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "hlod/query/fixed_latency_query_source.h"
#include "hlod/query/scripted_query_source.h"
#include "hlod/tree/hierarchy.h"
#include "hlod/view/projected_area.h"
#include "hlod/view/screen_error.h"
#include "traversals/frame_services.h"
#include "traversals/registry.h"

namespace hlodbench {

inline std::vector<std::string> listStrategyNames() {
  std::vector<std::string> names;
  for (const StrategyInfo& info : listStrategies()) names.emplace_back(info.name);
  return names;
}
// A strategy that decides everything itself and tells nobody what it predicts.
inline bool isWholePlugin(const StrategyInfo& info) {
  return info.descriptor != nullptr && info.descriptor->makeStrategy != nullptr;
}
inline std::vector<std::string> listPredictingNames() {
  std::vector<std::string> names;
  for (const StrategyInfo& info : listStrategies())
    if (!isWholePlugin(info)) names.emplace_back(info.name);
  return names;
}
// What a test of a strategy is called, where names may have no hyphen.
inline std::string nameTest(std::string strategy) {
  std::replace(strategy.begin(), strategy.end(), '-', '_');
  return strategy;
}

// A lens of which one world unit at distance 1 covers 480 pixels, and a camera at the origin that
// looks along -z.
inline Lens makeTestLens() {
  Lens lens;
  lens.fovyRad = 2.0 * std::atan(0.5);
  lens.nearPlane = 0.1;
  return lens;
}
inline Camera makeTestCamera() {
  return makeCamera(makeTestLens(), Pose{});
}

// A hierarchy written by hand: a root, and children added to it level by level.
class TinyTree {
 public:
  TinyTree() { hierarchy.nodes.push_back({.box = {{-2, -1, -14}, {2, 1, -10}}}); }

  // Adds a node's children, side by side along x within the parent's box.
  NodeId addChildren(NodeId parent, std::uint32_t count) {
    const auto first = static_cast<NodeId>(hierarchy.nodes.size());
    const Aabb box = hierarchy.nodes[parent].box;
    const float width = (box.max.x - box.min.x) / static_cast<float>(count);
    for (std::uint32_t i = 0; i < count; ++i) {
      Node node;
      node.box = box;
      node.box.min.x = box.min.x + width * static_cast<float>(i);
      node.box.max.x = node.box.min.x + width;
      node.parent = parent;
      node.level = hierarchy.nodes[parent].level + 1;
      node.indexCount = 3;
      hierarchy.nodes.push_back(node);
    }
    hierarchy.nodes[parent].firstChild = first;
    hierarchy.nodes[parent].childCount = count;
    return first;
  }

  // Gives the node the error that projects to `sse` pixels for the test camera.
  void setSse(NodeId node, double sse) {
    const Camera camera = makeTestCamera();
    const double distance = computeDistance(camera, hierarchy.nodes[node].box);
    hierarchy.nodes[node].error =
        static_cast<float>(sse * distance / computePixelScale(camera.lens));
  }

  // Makes the node's query pass this share of its projected area (at least one pixel above 0).
  void setMu(NodeId node, double mu) { mu_[node] = mu; }

  [[nodiscard]] std::uint32_t countPixels(NodeId node, const Camera& camera) const {
    const auto found = mu_.find(node);
    const double mu = found == mu_.end() ? 1.0 : found->second;
    if (mu <= 0.0) return 0;
    const double area = computeProjectedArea(camera, hierarchy.node(node).box);
    return static_cast<std::uint32_t>(std::max(1.0, std::round(mu * area)));
  }

  Hierarchy hierarchy;

 private:
  std::map<NodeId, double> mu_;
};

// Answers every query at once and draws nothing.
class InstantServices final : public FrameServices {
 public:
  InstantServices(const TinyTree& tree, const Camera& camera) : tree_(tree), camera_(camera) {}
  void draw(NodeId) override {}
  void issueQuery(NodeId) override {}
  bool isAvailable(NodeId) override { return true; }
  std::uint32_t getResult(NodeId node) override { return tree_.countPixels(node, camera_); }

 private:
  const TinyTree& tree_;
  const Camera& camera_;
};

// Root 0 over 1 and 2; 1 over the leaves 3 and 4, 2 is a leaf. Wholly visible unless said
// otherwise.
struct FiveNodes : TinyTree {
  FiveNodes() {
    addChildren(0, 2);
    addChildren(1, 2);
    setSse(0, 8.0);
    setSse(1, 4.0);
  }
};

// Renders frames of one strategy without GL and keeps the trace and the counters of the last one.
class ScriptedRun final : public FrameServices {
 public:
  ScriptedRun(const TinyTree& tree, const std::string& strategy, std::uint32_t latencyInDraws,
              const TraversalOptions& options = {})
      : tree_(tree),
        scripted_([this](NodeId n) { return tree_.countPixels(n, camera); },
                  tree.hierarchy.nodes.size()),
        queries_(scripted_, FixedLatencyQuerySource::Unit::kDraws, latencyInDraws,
                 tree.hierarchy.nodes.size()),
        recorder_(makeStopAndWaitStrategy({tree.hierarchy, options})),
        strategy_(findStrategy(strategy).make({tree.hierarchy, options, &recording})) {}

  // Returns the frame's decisions in words: "visit 0 delay, query 0, result 0 stop, draw 0".
  std::string renderFrame() {
    recordFrame();
    trace.clear();
    record = FrameRecord();
    queries_.beginFrame();
    strategy_->renderFrame(camera, *this, record, &trace);
    return describe();
  }

  // From now on each node has `factor` times as many pixels of error.
  void zoom(double factor) {
    camera.lens.height = static_cast<int>(std::lround(camera.lens.height * factor));
  }

  void draw(NodeId) override { queries_.noteDraw(); }
  void issueQuery(NodeId node) override { queries_.issue(node); }
  bool isAvailable(NodeId node) override { return queries_.isAvailable(node); }
  std::uint32_t getResult(NodeId node) override { return queries_.getResult(node); }

  [[nodiscard]] std::vector<NodeId> listDrawn() const {
    std::vector<NodeId> drawn;
    for (const TraceEvent& e : trace)
      if (e.type == TraceEvent::Type::kDraw) drawn.push_back(e.node);
    return drawn;
  }
  // 0 where the strategy does not have it.
  [[nodiscard]] int count(Counter counter) const {
    return record.has(counter) ? static_cast<int>(record.get(counter)) : 0;
  }

  Camera camera = makeTestCamera();
  Trace trace;
  FrameRecord record;
  FrontRecording recording;  // of SW(B), up to the last frame

 private:
  void recordFrame() {
    InstantServices services(tree_, camera);
    Trace events;
    FrameRecord counters;
    recorder_->renderFrame(camera, services, counters, &events);
    recording.frames.push_back(makeRecordedFrame(events, counters));
  }

  [[nodiscard]] std::string describe() const {
    std::string text;
    for (const TraceEvent& e : trace) {
      if (!text.empty()) text += ", ";
      const std::string node = std::to_string(e.node);
      switch (e.type) {
        case TraceEvent::Type::kVisit:
          text += "visit " + node;
          text += !e.inFrustum                          ? " outside"
                  : e.prediction == Prediction::kRefine ? " refine"
                  : e.prediction == Prediction::kStop   ? " stop"
                                                        : " delay";
          break;
        case TraceEvent::Type::kNear:
          text += "near " + node;
          break;
        case TraceEvent::Type::kQuery:
          text += "query " + node;
          break;
        case TraceEvent::Type::kResult:
          text += "result " + node + (e.pixels == 0 ? " hidden" : e.stop ? " stop" : " refine");
          break;
        case TraceEvent::Type::kDraw:
          text += "draw " + node;
          break;
        case TraceEvent::Type::kRarn:
          text += "rarn " + node;
          break;
      }
    }
    return text;
  }

  const TinyTree& tree_;
  ScriptedQuerySource scripted_;
  FixedLatencyQuerySource queries_;
  std::unique_ptr<Strategy> recorder_, strategy_;
};

}  // namespace hlodbench
