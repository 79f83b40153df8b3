#pragma once

#include <chrono>

#include "hlod/query/query_source.h"
#include "hlod/render/renderer.h"
#include "metrics/counters.h"
#include "test_slowdown.h"
#include "traversals/frame_services.h"

namespace hlodbench {

// Wall time of a frame's calls by what they were for, milliseconds.
struct ServiceTimes {
  double draw = 0.0;   // drawing nodes
  double query = 0.0;  // issuing queries and asking whether they are done
  double wait = 0.0;   // getting results
};

// strategyMs: of the strategy's frame, milliseconds, these included.
inline void storeServiceTimes(const ServiceTimes& times, double strategyMs, FrameRecord& record) {
  record.set(Counter::kWaitMs, times.wait);
  record.set(Counter::kDrawMs, times.draw);
  record.set(Counter::kQueryMs, times.query);
  record.set(Counter::kTraversalMs, strategyMs - times.draw - times.query - times.wait);
}

// Joins a renderer and a query source to what a strategy asks for, and times it.
class GlFrameServices final : public FrameServices {
 public:
  using Clock = std::chrono::steady_clock;

  GlFrameServices(Renderer& renderer, QuerySource& queries, const Slowdown& slowdown = {})
      : renderer_(renderer), queries_(queries), slowdown_(slowdown) {}

  void draw(NodeId node) override {
    const Lap lap(draw_, slowdown_.draw);
    renderer_.drawNode(node);
    queries_.noteDraw();
  }
  // In one call for the whole front, but for what the kinds of its nodes force apart. Under a
  // budget node by node: what is not there yet must be drawn as an ancestor, as for everybody, not
  // waited for.
  void drawAll(std::span<const NodeId> nodes) override {
    if (renderer_.isLimited()) {
      FrameServices::drawAll(nodes);
      return;
    }
    const Lap lap(draw_, slowdown_.draw);
    renderer_.drawNodes(nodes);
    for (std::size_t i = 0; i < nodes.size(); ++i) queries_.noteDraw();
  }
  void issueQuery(NodeId node) override {
    const Lap lap(query_, slowdown_.query);
    queries_.issue(node);
  }
  bool isAvailable(NodeId node) override {
    const Lap lap(query_, slowdown_.query);
    return queries_.isAvailable(node);
  }
  std::uint32_t getResult(NodeId node) override {
    const Lap lap(wait_, slowdown_.query);
    return queries_.getResult(node);
  }

  // The time since `start` that went into none of these calls.
  [[nodiscard]] Clock::duration timeOfCaller(Clock::time_point start) const {
    return Clock::now() - start - draw_ - query_ - wait_;
  }
  // Of the calls since it was last asked.
  ServiceTimes takeTimes() {
    const ServiceTimes times{toMs(draw_), toMs(query_), toMs(wait_)};
    draw_ = query_ = wait_ = {};
    return times;
  }

 private:
  // Adds its own lifetime to a sum.
  class Lap {
   public:
    Lap(Clock::duration& sum, double slowdown)
        : sum_(sum), slowdown_(slowdown), start_(Clock::now()) {}
    ~Lap() {
      if (slowdown_ > 0.0) spin(Clock::now() - start_, slowdown_);
      sum_ += Clock::now() - start_;
    }
    Lap(const Lap&) = delete;
    Lap& operator=(const Lap&) = delete;

   private:
    Clock::duration& sum_;
    double slowdown_;
    Clock::time_point start_;
  };
  static double toMs(Clock::duration duration) {
    return std::chrono::duration<double, std::milli>(duration).count();
  }

  Renderer& renderer_;
  QuerySource& queries_;
  Slowdown slowdown_;
  Clock::duration draw_{}, query_{}, wait_{};
};

}  // namespace hlodbench
