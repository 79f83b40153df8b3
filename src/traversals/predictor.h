#pragma once

#include "traversals/prediction_context.h"
#include "traversals/trace_event.h"

namespace hlodbench {

// Guesses, before a node's visibility is known, how its refinement will end. To compare an idea of
// your own, write one of these: the coherent traversal (paper, Fig. 2) does the rest.
class Predictor {
 public:
  virtual ~Predictor() = default;

  // A new frame starts; context.states still hold the last one's.
  virtual void beginFrame(const PredictionContext& /*context*/) {}

  // The node is inside the frustum and about to be taken up.
  virtual Prediction predict(NodeId node, const PredictionContext& context) = 0;

  // A query of this frame passed at least one pixel and set the node's bias.
  virtual void onVisible(NodeId /*node*/, double /*bias*/) {}
};

}  // namespace hlodbench
