#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "hlod/render/page_layout.h"

namespace hlodbench {
namespace {

// Nodes whose blocks, some of them empty, stand in an order of their own.
Hierarchy makeBlocks(std::mt19937& random) {
  Hierarchy hierarchy;
  std::vector<NodeId> order;
  hierarchy.nodes.resize(1 + random() % 60);
  for (NodeId id = 0; id < hierarchy.nodes.size(); ++id) {
    Node& node = hierarchy.nodes[id];
    node.vertexCount = random() % 40;
    node.indexCount = 3 * node.vertexCount;
    order.push_back(id);
  }
  if (random() % 2 == 0) std::shuffle(order.begin(), order.end(), random);
  std::uint64_t end = 0;
  for (const NodeId id : order) {
    hierarchy.nodes[id].geometryOffset = end;
    end += hierarchy.nodes[id].blockBytes();
  }
  hierarchy.geometry = GeometrySection(std::vector<std::byte>(end));
  return hierarchy;
}

TEST(PageLayout, PutsEveryBlockWholeIntoAPage) {
  std::mt19937 random(1);
  for (int round = 0; round < 200; ++round) {
    const Hierarchy h = makeBlocks(random);
    const PageLayout layout = computePageLayout(h, 1 + random() % 4000);
    ASSERT_EQ(layout.places.size(), h.nodes.size());
    for (NodeId id = 0; id < h.nodes.size(); ++id) {
      const auto [page, offset] = layout.places[id];
      ASSERT_LT(page, layout.pages.size());
      const std::span<const std::byte> block = h.geometryBytes(h.node(id));
      ASSERT_LE(offset + block.size(), layout.pages[page].size());
      EXPECT_EQ(layout.pages[page].data() + offset, block.data());
    }
  }
}

TEST(PageLayout, MakesFullPagesAndLargerOnesForLargerBlocksOnly) {
  std::mt19937 random(2);
  for (int round = 0; round < 200; ++round) {
    const Hierarchy h = makeBlocks(random);
    const std::uint64_t most = 1 + random() % 4000;
    const PageLayout layout = computePageLayout(h, most);
    std::vector<std::uint64_t> first(layout.pages.size(),
                                     0);              // block of the page that is not empty
    std::vector<int> blocks(layout.pages.size(), 0);  // that are not empty
    for (NodeId id = 0; id < h.nodes.size(); ++id) {
      const auto [page, offset] = layout.places[id];
      const std::uint64_t size = h.node(id).blockBytes();
      if (size == 0) continue;
      ++blocks[page];
      if (offset == 0) first[page] = size;
    }
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < layout.pages.size(); ++i) {
      const std::uint64_t size = layout.pages[i].size();
      sum += size;
      EXPECT_TRUE(size <= most || blocks[i] == 1) << size << " of " << most;
      // the next one's first block had no room
      if (i + 1 < layout.pages.size()) {
        EXPECT_GT(size + first[i + 1], most);
      }
    }
    EXPECT_EQ(sum, h.geometry.bytes().size());
  }
}

}  // namespace
}  // namespace hlodbench
