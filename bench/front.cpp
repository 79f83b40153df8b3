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

std::vector<NodeId> listLeavesInside(const Hierarchy& hierarchy, const Frustum& frustum) {
  std::vector<NodeId> leaves;
  for (NodeId id = 0; id < hierarchy.nodes.size(); ++id)
    if (hierarchy.node(id).isLeaf() && frustum.intersects(hierarchy.node(id).box))
      leaves.push_back(id);
  return leaves;
}

}  // namespace hlodbench
