#include "view/node_boxes.h"

#include <unordered_set>

namespace hlodbench {
namespace {

class NodeList {
 public:
  explicit NodeList(std::vector<NodeId>& nodes) : nodes_(nodes) {}
  void add(NodeId node) {
    if (known_.insert(node).second) nodes_.push_back(node);
  }

 private:
  std::vector<NodeId>& nodes_;
  std::unordered_set<NodeId> known_;
};

}  // namespace

NodeBoxes collectBoxes(const Trace& events) {
  NodeBoxes boxes;
  NodeList drawn(boxes.drawn), visible(boxes.visible), occluded(boxes.occluded),
      culled(boxes.culled);
  for (const TraceEvent& event : events) {
    switch (event.type) {
      case TraceEvent::Type::kDraw:
        drawn.add(event.node);
        break;
      case TraceEvent::Type::kResult:
        (event.pixels > 0 ? visible : occluded).add(event.node);
        break;
      case TraceEvent::Type::kVisit:
        if (!event.inFrustum) culled.add(event.node);
        break;
      default:
        break;
    }
  }
  return boxes;
}

}  // namespace hlodbench
