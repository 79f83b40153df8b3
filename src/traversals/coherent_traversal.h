#pragma once

#include <memory>

#include "traversals/hierarchy_traversal.h"
#include "traversals/node_queue.h"
#include "traversals/predictor.h"

namespace hlodbench {

// The coherent HLOD traversal of the paper's Fig. 2; what it predicts is the predictor's. In short:
//
//   push root
//   while nodes or queries are left:
//     while a query is finished, or only queries are left:    finish it: if visible, draw or refine
//     take the nearest node: if inside the frustum, predict:  refine -> push its children
//                                                             stop   -> query it and draw it
//                                                             delay  -> query it
class CoherentTraversal final : public HierarchyTraversal {
 public:
  CoherentTraversal(const Hierarchy& hierarchy, const TraversalOptions& options,
                    Modulation modulation, std::unique_ptr<Predictor> predictor);

 private:
  void doFrame() override;
  void finish(NodeId node);
  void visit(NodeId node);

  std::unique_ptr<Predictor> predictor_;
  NodeQueue queryQueue_;
};

}  // namespace hlodbench
