#include "hlod/render/page_layout.h"

#include <algorithm>
#include <numeric>

namespace hlodbench {
namespace {

// Blocks stand in the order of the nodes where our writer put them, but need not.
std::vector<NodeId> listByOffset(const Hierarchy& hierarchy) {
  std::vector<NodeId> order(hierarchy.nodes.size());
  std::iota(order.begin(), order.end(), kRoot);
  std::stable_sort(order.begin(), order.end(), [&](NodeId a, NodeId b) {
    return hierarchy.node(a).geometryOffset < hierarchy.node(b).geometryOffset;
  });
  return order;
}

}  // namespace

PageLayout computePageLayout(const Hierarchy& hierarchy, std::uint64_t most) {
  const std::span<const std::byte> geometry = hierarchy.geometry.bytes();
  PageLayout layout;
  layout.places.resize(hierarchy.nodes.size());
  std::uint64_t begin = 0, end = 0;  // of the last page, bytes into the geometry
  for (const NodeId id : listByOffset(hierarchy)) {
    const Node& node = hierarchy.node(id);
    const std::uint64_t blockEnd = node.geometryOffset + node.blockBytes();
    if (layout.pages.empty() || (end > begin && blockEnd - begin > most)) {
      layout.pages.emplace_back();
      begin = end = node.geometryOffset;
    }
    end = std::max(end, blockEnd);
    layout.pages.back() = geometry.subspan(begin, end - begin);
    layout.places[id] = {static_cast<std::uint32_t>(layout.pages.size() - 1),
                         node.geometryOffset - begin};
  }
  return layout;
}

}  // namespace hlodbench
