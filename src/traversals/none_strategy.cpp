// A limit to compare with: HLOD without occlusion culling. The screen-space error (J. P.
// Charalambos et al., ISVC 2007, section 3.1) and the frustum decide alone.
#include "traversals/strategies.h"
#include "traversals/unqueried_traversal.h"

namespace hlodbench {
namespace {

class ErrorTraversal final : public UnqueriedTraversal {
 public:
  using UnqueriedTraversal::UnqueriedTraversal;

 private:
  [[nodiscard]] bool stopsAt(NodeId node) const override { return isWithinTolerance(node); }
};

}  // namespace

std::unique_ptr<Strategy> makeNoneStrategy(const StrategyInputs& inputs) {
  return std::make_unique<ErrorTraversal>(inputs.hierarchy, inputs.options);
}

}  // namespace hlodbench
