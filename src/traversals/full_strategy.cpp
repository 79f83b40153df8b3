// A limit to compare with: the model at full resolution, every leaf whose box meets the frustum.
#include "traversals/strategies.h"
#include "traversals/unqueried_traversal.h"

namespace hlodbench {
namespace {

class LeafTraversal final : public UnqueriedTraversal {
 public:
  using UnqueriedTraversal::UnqueriedTraversal;

 private:
  [[nodiscard]] bool stopsAt(NodeId node) const override { return view().node(node).isLeaf(); }
};

}  // namespace

std::unique_ptr<Strategy> makeFullStrategy(const StrategyInputs& inputs) {
  return std::make_unique<LeafTraversal>(inputs.hierarchy, inputs.options);
}

}  // namespace hlodbench
