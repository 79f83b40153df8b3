#pragma once

#include <cstdint>
#include <span>

#include "hlod/tree/hierarchy.h"

namespace hlodbench {

// Receives the geometry of nodes while they are made, in any order, each once; may be called from
// several threads. Ids are numbers from 0 without gaps; which node has which, the maker says in the
// end, and it may be another in every run.
class NodeSink {
 public:
  virtual ~NodeSink() = default;
  // indices: 3 a triangle, below vertices.size(). Vertex order and triangle order are optimised and
  // packed by the sink.
  virtual void addGeometry(NodeId id, std::span<const Vertex> vertices,
                           std::span<const std::uint32_t> indices) = 0;
};

}  // namespace hlodbench
