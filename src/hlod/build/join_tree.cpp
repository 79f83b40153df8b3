#include "hlod/build/top_builder.h"

namespace hlodbench {
namespace {

// A node of the whole tree by where it was built.
struct Place {
  std::uint32_t chunk;  // kTop: above the chunks
  std::uint32_t node;
};
constexpr std::uint32_t kTop = 0xffffffffu;

Place placeOf(const ChunkPlan& plan, std::uint32_t topNode) {
  const TopNode& node = plan.nodes[topNode];
  return node.isChunk() ? Place{node.firstChunk, 0} : Place{kTop, topNode};
}

// Whether all objects of a leaf are consistently wound.
std::vector<std::vector<std::uint8_t>> findEvenLeaves(const std::vector<BuiltChunk>& chunks,
                                                      const WindingCheck& winding) {
  std::vector<std::vector<std::uint8_t>> even(chunks.size());
  for (std::size_t chunk = 0; chunk < chunks.size(); ++chunk) {
    even[chunk].assign(chunks[chunk].nodes.size(), 1);
    for (const auto& [leaf, object] : chunks[chunk].leafObjects)
      if (!winding.isConsistent(object)) even[chunk][leaf] = 0;
  }
  return even;
}

}  // namespace

BuiltTree joinTree(const ChunkPlan& plan, const std::vector<BuiltNode>& top,
                   const std::vector<std::uint8_t>& turned, const std::vector<BuiltChunk>& chunks,
                   const WindingCheck& winding) {
  BuiltTree tree;
  std::vector<Place> places{placeOf(plan, 0)};
  std::vector<std::uint8_t> folded;  // one a node: its LOD was turned
  std::vector<NodeId> parents{kNoNode};
  for (NodeId id = 0; id < places.size(); ++id) {
    const Place place = places[id];
    const bool isTop = place.chunk == kTop;
    BuiltNode node = isTop ? top[place.node] : chunks[place.chunk].nodes[place.node];
    folded.push_back(isTop ? turned[place.node] : chunks[place.chunk].turned[place.node]);
    node.parent = parents[id];
    node.level = node.parent == kNoNode ? 0 : tree.nodes[node.parent].level + 1;
    for (std::uint32_t i = 0; i < node.childCount; ++i) {
      places.push_back(isTop ? placeOf(plan, plan.nodes[place.node].children[i])
                             : Place{place.chunk, node.firstChild + i});
      parents.push_back(id);
    }
    node.firstChild =
        node.childCount == 0 ? kNoNode : static_cast<NodeId>(places.size() - node.childCount);
    tree.nodes.push_back(node);
  }
  const std::vector<std::vector<std::uint8_t>> even = findEvenLeaves(chunks, winding);
  std::vector<std::uint8_t> evenBelow(tree.nodes.size(), 1);
  for (NodeId id = static_cast<NodeId>(tree.nodes.size()); id-- > 0;) {
    BuiltNode& node = tree.nodes[id];
    if (node.childCount == 0) evenBelow[id] = even[places[id].chunk][places[id].node];
    node.consistentWinding = evenBelow[id] != 0 && folded[id] == 0;
    if (evenBelow[id] == 0 && node.parent != kNoNode) evenBelow[node.parent] = 0;
  }
  return tree;
}

}  // namespace hlodbench
