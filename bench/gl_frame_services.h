#pragma once

#include <chrono>

#include "hlod/query/query_source.h"
#include "hlod/render/renderer.h"
#include "metrics/counters.h"
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
  GlFrameServices(Renderer& renderer, QuerySource& queries)
      : renderer_(renderer), queries_(queries) {}

  void draw(NodeId node) override {
    const Lap lap(draw_);
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
    const Lap lap(draw_);
    renderer_.drawNodes(nodes);
    for (std::size_t i = 0; i < nodes.size(); ++i) queries_.noteDraw();
  }
  void issueQuery(NodeId node) override {
    const Lap lap(query_);
    queries_.issue(node);
  }
  bool isAvailable(NodeId node) override {
    const Lap lap(query_);
    return queries_.isAvailable(node);
  }
  std::uint32_t getResult(NodeId node) override {
    const Lap lap(wait_);
    return queries_.getResult(node);
  }

  // Of the calls since it was last asked.
  ServiceTimes takeTimes() {
    const ServiceTimes times{toMs(draw_), toMs(query_), toMs(wait_)};
    draw_ = query_ = wait_ = {};
    return times;
  }

 private:
  using Clock = std::chrono::steady_clock;
  // Adds its own lifetime to a sum.
  class Lap {
   public:
    explicit Lap(Clock::duration& sum) : sum_(sum), start_(Clock::now()) {}
    ~Lap() { sum_ += Clock::now() - start_; }
    Lap(const Lap&) = delete;
    Lap& operator=(const Lap&) = delete;

   private:
    Clock::duration& sum_;
    Clock::time_point start_;
  };
  static double toMs(Clock::duration duration) {
    return std::chrono::duration<double, std::milli>(duration).count();
  }

  Renderer& renderer_;
  QuerySource& queries_;
  Clock::duration draw_{}, query_{}, wait_{};
};

}  // namespace hlodbench
