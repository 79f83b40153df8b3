#include "hlod/query/fixed_latency_query_source.h"

namespace hlodbench {

FixedLatencyQuerySource::FixedLatencyQuerySource(QuerySource& results, Unit unit,
                                                 std::uint32_t latency, std::size_t nodeCount)
    : results_(results), unit_(unit), latency_(latency), issuedAt_(nodeCount, 0) {}

void FixedLatencyQuerySource::beginFrame() {
  ++frames_;
  results_.beginFrame();
}

void FixedLatencyQuerySource::issue(NodeId node) {
  issuedAt_[node] = unit_ == Unit::kDraws ? draws_ : frames_;
  results_.issue(node);
}

bool FixedLatencyQuerySource::isAvailable(NodeId node) {
  return (unit_ == Unit::kDraws ? draws_ : frames_) - issuedAt_[node] >= latency_;
}

std::uint32_t FixedLatencyQuerySource::getResult(NodeId node) {
  return results_.getResult(node);
}

void FixedLatencyQuerySource::noteDraw() {
  ++draws_;
  results_.noteDraw();
}

}  // namespace hlodbench
