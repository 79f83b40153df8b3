#pragma once

#include <mutex>
#include <vector>

#include "hlod/tree/node_sink.h"

namespace hlodbench {

// Collects geometry in memory, for a hierarchy that owns its bytes.
class MemorySink final : public NodeSink {
 public:
  void addGeometry(NodeId id, std::span<const Vertex> vertices,
                   std::span<const std::uint32_t> indices) override;

  // Sets the geometry of hierarchy.nodes and hierarchy.geometry, blocks in the order of the nodes.
  // ids: the ids under which the nodes' geometry was given, by node; empty when these are the
  // nodes' own numbers. Every node must have been given. To be called once.
  void finish(Hierarchy& hierarchy, std::span<const NodeId> ids = {});

 private:
  struct Block {
    Node node;  // what describes the block
    std::vector<std::byte> bytes;
  };
  std::mutex mutex_;
  std::vector<Block> blocks_;  // by id
};

}  // namespace hlodbench
