#pragma once

#include <cstdint>

#include "hlod/tree/hierarchy.h"

namespace hlodbench {

// Where occlusion queries are answered. At most one query a node and frame; its result may be asked
// for in that frame or a later one, until the node's next query replaces it.
class QuerySource {
 public:
  virtual ~QuerySource() = default;

  virtual void beginFrame() {}
  // Counts, from now on, the pixels of the node's box that pass the depth test.
  virtual void issue(NodeId node) = 0;
  // True when getResult() would not have to wait.
  virtual bool isAvailable(NodeId node) = 0;
  // Pixels that passed; waits for the result if need be.
  virtual std::uint32_t getResult(NodeId node) = 0;
  // A node was drawn: the clock of sources whose latency is counted in draws.
  virtual void noteDraw() {}
};

}  // namespace hlodbench
