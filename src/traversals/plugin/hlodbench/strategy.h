#pragma once

#include "frame_view.h"

namespace hlodbench::plugin {

// What a strategy does in a frame. The order of the calls is the order in which the GPU sees them.
// Each throws std::logic_error for a node that there is not and for what its comment rules out; the
// replay has failed then, also where the strategy catches the exception.
class Frame {
 public:
  // Draws the node's triangles; at most once a frame.
  virtual void draw(NodeId node) = 0;
  // Starts an occlusion query on the node's box; at most one a frame. Its result may be asked for
  // in this frame or a later one, until the node's next query replaces it.
  virtual void issueQuery(NodeId node) = 0;
  // True when getResult() would not have to wait. Costs little; may be asked repeatedly. Only after
  // issueQuery(), as the next.
  virtual bool isAvailable(NodeId node) = 0;
  // Pixels of the box that passed the depth test when the query was issued; waits if need be. Sets
  // the node's state: pixels, mu, bias, visible.
  virtual std::uint32_t getResult(NodeId node) = 0;
  // For the counter nodes_visited: the node is taken up. Leave it out, and the counter is absent.
  virtual void noteVisit(NodeId node) = 0;
  // For the counters delays and d: drawing the node, if it comes to that, waits for a result. They
  // are absent before the first.
  virtual void noteDelay(NodeId node) = 0;

 protected:
  ~Frame() = default;
};

// A whole technique of rendering. An object lives for one replay of the session and starts cold.
// The program counts what it draws and queries. Of the states it keeps: lastVisited (draw,
// issueQuery or noteVisit), lastRendered, pixels, mu, bias and visible (getResult), delayed
// (noteDelay); stopRefinement says that the node was drawn in frame lastVisited, and nothing below
// it after it.
class Strategy {
 public:
  virtual ~Strategy() = default;

  // Renders one frame: draws nodes so that each visible leaf has itself or an ancestor drawn.
  virtual void renderFrame(const FrameView& view, Frame& frame) = 0;
};

}  // namespace hlodbench::plugin
