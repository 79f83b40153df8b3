#pragma once

#include <cstdint>
#include <span>

#include "hlod/tree/hierarchy.h"

namespace hlodbench {

// What a strategy may ask for during a frame. The order of the calls is the order in which the GPU
// sees them. No strategy sees more of the renderer than this.
class FrameServices {
 public:
  virtual ~FrameServices() = default;

  // Draws the LOD of a node.
  virtual void draw(NodeId node) = 0;

  // Draws the LODs of nodes, in this order: the picture of draw() for each, by the fastest way that
  // there is.
  virtual void drawAll(std::span<const NodeId> nodes) {
    for (const NodeId node : nodes) draw(node);
  }

  // Starts an occlusion query on the node's box; at most one a node and frame. Its result may be
  // asked for in this frame or a later one, until the node's next query replaces it.
  virtual void issueQuery(NodeId node) = 0;

  // True when getResult() would not have to wait. Costs little; may be asked repeatedly.
  virtual bool isAvailable(NodeId node) = 0;

  // Pixels of the box that passed the depth test when the query was issued. Waits for the result.
  virtual std::uint32_t getResult(NodeId node) = 0;
};

}  // namespace hlodbench
