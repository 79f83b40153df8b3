#pragma once

#include <cstdint>
#include <vector>

#include "hlod/query/query_source.h"

namespace hlodbench {

// Takes its results from another source, and decides itself when they are there: a fixed number of
// drawn nodes, or of frames, after the query was issued. What a strategy does then no longer
// depends on the machine's speed: counts are the same in every run on one driver. Asking for a
// result earlier is allowed, as with any source: it means waiting.
class FixedLatencyQuerySource final : public QuerySource {
 public:
  enum class Unit { kDraws, kFrames };

  // latency >= 0. A latency in frames of 1 or more means that within the frame no result is ever
  // there unless waited for, since every traversal of the paper ends its frame with all results.
  FixedLatencyQuerySource(QuerySource& results, Unit unit, std::uint32_t latency,
                          std::size_t nodeCount);

  void beginFrame() override;
  void issue(NodeId node) override;
  bool isAvailable(NodeId node) override;
  std::uint32_t getResult(NodeId node) override;
  void noteDraw() override;

 private:
  QuerySource& results_;
  Unit unit_;
  std::uint32_t latency_;
  std::uint64_t draws_ = 0;
  std::uint64_t frames_ = 0;
  std::vector<std::uint64_t> issuedAt_;  // one a node, in the unit
};

}  // namespace hlodbench
