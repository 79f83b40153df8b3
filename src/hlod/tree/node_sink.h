#pragma once

#include <cstdint>
#include <span>

#include "hlod/tree/hierarchy.h"

namespace hlodbench {

// Receives nodes of a hierarchy while they are made, in any order, each once; may be called from
// several threads.
class NodeSink {
 public:
  virtual ~NodeSink() = default;
  // indices: 3 a triangle, below vertices.size(). Vertex order and triangle order are optimised and
  // packed by the sink.
  virtual void addGeometry(NodeId id, std::span<const Vertex> vertices,
                           std::span<const std::uint32_t> indices) = 0;
};

}  // namespace hlodbench
