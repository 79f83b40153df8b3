#pragma once

#include "frame_view.h"

namespace hlodbench::plugin {

// How a node goes on before its visibility in this frame is known (paper, section 4.1).
enum class Prediction : std::uint8_t {
  kRefine,  // traverse the children at once; costs geometry if it was too conservative
  kStop,    // query and draw at once; costs a RARN if it was too aggressive
  kDelay    // query and wait for the result; costs latency if the node is drawn after all
};

// How occlusion enters the refinement condition.
enum class Modulation : std::uint32_t {
  kNone,  // SSE alone: queries are as if their result were boolean, and the bias is always 1
  kBias   // VMSSE = B(mu) * SSE (paper, Eq. 1)
};

// Guesses, before a node's visibility is known, how its refinement will end. To compare an idea of
// your own, write one of these: the coherent traversal (paper, Fig. 2) does the rest. An object
// lives for one replay of the session and starts cold.
class Predictor {
 public:
  virtual ~Predictor() = default;

  // A new frame starts; the states are still the last one's.
  virtual void beginFrame(const FrameView& /*view*/) {}

  // The node is inside the frustum and about to be taken up; the nearest comes first. The states of
  // nodes taken up before it are already this frame's. A leaf predicted kRefine is taken as kStop.
  virtual Prediction predict(NodeId node, const FrameView& view) = 0;

  // A query of this frame has a result: view.state(node) has its pixels, mu and bias.
  virtual void onResult(NodeId /*node*/, const FrameView& /*view*/) {}
};

}  // namespace hlodbench::plugin
