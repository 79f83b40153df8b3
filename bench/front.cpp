#include "front.h"

#include <unordered_map>

namespace hlodbench {

Front computeFront(int frame, const Trace& events) {
  Front front{frame, {}};
  std::unordered_map<NodeId, std::size_t> places;
  std::unordered_map<NodeId, float> biases;
  for (const TraceEvent& event : events) {
    if (event.type == TraceEvent::Type::kDraw) {
      places[event.node] = front.nodes.size();
      front.nodes.push_back({event.node});
    } else if (event.type == TraceEvent::Type::kResult) {
      biases[event.node] = static_cast<float>(event.bias);
    } else if (event.type == TraceEvent::Type::kRarn) {
      front.nodes[places.at(event.node)].refined = true;
    }
  }
  for (DrawnNode& drawn : front.nodes)
    if (const auto bias = biases.find(drawn.node); bias != biases.end()) drawn.bias = bias->second;
  return front;
}

}  // namespace hlodbench
