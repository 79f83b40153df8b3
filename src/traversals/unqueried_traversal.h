#pragma once

#include "traversals/hierarchy_traversal.h"

namespace hlodbench {

// A traversal that asks nothing: the frustum alone says what is seen, a subclass where refinement
// ends. Nearest nodes come first.
class UnqueriedTraversal : public HierarchyTraversal {
 public:
  UnqueriedTraversal(const Hierarchy& hierarchy, const TraversalOptions& options)
      : HierarchyTraversal(hierarchy, options, Modulation::kNone) {}

 private:
  [[nodiscard]] virtual bool stopsAt(NodeId node) const = 0;

  [[nodiscard]] bool asksQueries() const final { return false; }

  void doFrame() final {
    push(kRoot);
    while (!isQueueEmpty()) visit(popNearest());
  }

  void visit(NodeId node) {
    if (!isInsideViewFrustum(node)) return;
    beginVisit(node, stopsAt(node) ? Prediction::kStop : Prediction::kRefine);
    traverse(node);
  }
};

}  // namespace hlodbench
