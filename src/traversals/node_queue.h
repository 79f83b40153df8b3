#pragma once

#include <cstddef>
#include <vector>

#include "hlod/tree/hierarchy.h"

namespace hlodbench {

// First in, first out, in a ring that only ever grows: std::queue takes and returns memory in every
// frame.
class NodeQueue {
 public:
  NodeQueue() : ring_(64) {}
  [[nodiscard]] bool empty() const { return count_ == 0; }
  [[nodiscard]] NodeId front() const { return ring_[first_]; }
  void push(NodeId node) {
    if (count_ == ring_.size()) grow();
    ring_[(first_ + count_) & (ring_.size() - 1)] = node;
    ++count_;
  }
  void pop() {
    first_ = (first_ + 1) & (ring_.size() - 1);
    --count_;
  }

 private:
  void grow() {
    std::vector<NodeId> larger(ring_.size() * 2);
    for (std::size_t i = 0; i < count_; ++i) larger[i] = ring_[(first_ + i) & (ring_.size() - 1)];
    ring_ = std::move(larger);
    first_ = 0;
  }

  std::vector<NodeId> ring_;  // a power of two
  std::size_t first_ = 0;
  std::size_t count_ = 0;
};

}  // namespace hlodbench
