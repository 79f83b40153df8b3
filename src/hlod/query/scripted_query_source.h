#pragma once

#include <functional>
#include <utility>

#include "hlod/query/query_source.h"

namespace hlodbench {

// Answers from a function, at once and with no GL: for tests and for studying a traversal alone.
// Give it a latency by wrapping it in a FixedLatencyQuerySource.
class ScriptedQuerySource final : public QuerySource {
 public:
  using Script = std::function<std::uint32_t(NodeId)>;  // pixels that pass, asked when issued

  explicit ScriptedQuerySource(Script script, std::size_t nodeCount)
      : script_(std::move(script)), results_(nodeCount, 0) {}

  void issue(NodeId node) override { results_[node] = script_(node); }
  bool isAvailable(NodeId /*node*/) override { return true; }
  std::uint32_t getResult(NodeId node) override { return results_[node]; }

 private:
  Script script_;
  std::vector<std::uint32_t> results_;
};

}  // namespace hlodbench
