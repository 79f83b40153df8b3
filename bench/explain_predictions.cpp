#include "explain_predictions.h"

#include <stdexcept>
#include <string>
#include <unordered_map>

namespace hlodbench {
namespace {

enum class Outcome { kRefined, kDrawn, kCulled };

}  // namespace

PredictionCounts judgePredictions(const Hierarchy& hierarchy,
                                  const std::vector<PredictedNode>& predictions,
                                  const RecordedFrame& truth) {
  std::unordered_map<NodeId, Outcome> outcomes;
  for (const NodeId node : truth.refined) outcomes[node] = Outcome::kRefined;
  for (const NodeId node : truth.drawn) outcomes[node] = Outcome::kDrawn;
  for (const NodeId node : truth.hidden) outcomes[node] = Outcome::kCulled;

  PredictionCounts counts;
  for (const auto& [node, prediction] : predictions) {
    // the lowest node above that SW(B) decided: it ended there, unless that is the node itself
    NodeId decided = node;
    auto found = outcomes.find(decided);
    while (found == outcomes.end() && decided != kNoNode) {
      decided = hierarchy.node(decided).parent;
      found = outcomes.find(decided);
    }
    const bool isReached = decided == node;
    if (found == outcomes.end() || (!isReached && found->second == Outcome::kRefined))
      throw std::invalid_argument("judgePredictions: SW(B) decided nothing about node " +
                                  std::to_string(node));
    const Outcome outcome = found->second;
    int PredictionCounts::*count = &PredictionCounts::right;
    switch (prediction) {
      case Prediction::kRefine:
        if (outcome != Outcome::kRefined) count = &PredictionCounts::tooConservative;
        break;
      case Prediction::kStop:
        if (outcome == Outcome::kRefined) count = &PredictionCounts::tooAggressive;
        if (outcome == Outcome::kCulled) count = &PredictionCounts::tooConservative;
        break;
      case Prediction::kDelay:
        if (isReached && outcome != Outcome::kCulled) count = &PredictionCounts::needlessDelays;
        break;
    }
    ++(counts.*count);
  }
  return counts;
}

}  // namespace hlodbench
