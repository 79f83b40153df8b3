#include "front.h"

#include <gmock/gmock.h>

#include "hlod/core/error.h"
#include "overlay.h"

namespace hlodbench {
namespace {

using Type = TraceEvent::Type;

// Node 1 is drawn on a Stop, then refined into 2 and 3; 4 is culled.
Trace makeTrace() {
  return {{.type = Type::kVisit, .node = 1, .inFrustum = true},
          {.type = Type::kQuery, .node = 1},
          {.type = Type::kDraw, .node = 1},
          {.type = Type::kResult, .node = 4, .bias = 0.0},
          {.type = Type::kResult, .node = 1, .bias = 0.75},
          {.type = Type::kRarn, .node = 1},
          {.type = Type::kResult, .node = 2, .bias = 0.25},
          {.type = Type::kDraw, .node = 2},
          {.type = Type::kNear, .node = 3},
          {.type = Type::kDraw, .node = 3}};
}

Hierarchy makeTree() {
  Hierarchy tree;
  tree.nodes.resize(5);
  for (NodeId id = 1; id < 5; ++id) {
    tree.nodes[id].parent = id < 2 ? kRoot : id == 4 ? kRoot : 1;
    tree.nodes[id].level = id == 2 || id == 3 ? 2 : 1;
  }
  return tree;
}

TEST(Front, HoldsWhatWasDrawnInOrder) {
  const Front front = computeFront(7, makeTrace());
  EXPECT_EQ(front.frame, 7);
  ASSERT_EQ(front.nodes.size(), 3u);
  EXPECT_EQ(front.nodes[0].node, 1u);
  EXPECT_EQ(front.nodes[1].node, 2u);
  EXPECT_EQ(front.nodes[2].node, 3u);
  EXPECT_EQ(front.nodes[0].bias, 0.75f);
  EXPECT_EQ(front.nodes[1].bias, 0.25f);
  EXPECT_EQ(front.nodes[2].bias, 1.0f) << "no query: not modulated";
  EXPECT_TRUE(front.nodes[0].refined);
  EXPECT_FALSE(front.nodes[1].refined);
}

TEST(Overlay, ColoursEveryNode) {
  const Hierarchy tree = makeTree();
  const Front front = computeFront(0, makeTrace());
  for (const OverlayInfo& overlay : listOverlays()) {
    const std::vector<glm::vec3> tints = overlay.computeTints(tree, front);
    ASSERT_EQ(tints.size(), front.nodes.size()) << overlay.name;
    for (const glm::vec3& tint : tints)
      for (int c = 0; c < 3; ++c) {
        EXPECT_GE(tint[c], 0.0f) << overlay.name;
        EXPECT_LE(tint[c], 1.0f) << overlay.name;
      }
  }
}

std::vector<glm::vec3> computeTints(const char* name) {
  return findOverlay(name).computeTints(makeTree(), computeFront(0, makeTrace()));
}

TEST(Overlay, OfTheBiasGoesFromBlueToRed) {
  const auto tints = computeTints("bias");  // biases 0.75, 0.25, 1
  EXPECT_GT(tints[2].b, 5 * tints[2].r) << "weak: blue";
  EXPECT_GT(tints[0].b, 0.3f);
  EXPECT_GT(tints[0].r, 0.3f) << "between: magenta";
  EXPECT_GT(tints[1].r, tints[1].b) << "strong: red";
}

TEST(Overlay, OfLevelsTellsThemApart) {
  const auto tints = computeTints("level");
  EXPECT_EQ(tints[1], tints[2]);
  EXPECT_NE(tints[0], tints[1]);
}

TEST(Overlay, OfNodesTellsThemApart) {
  const auto tints = computeTints("node");
  EXPECT_NE(tints[1], tints[2]);
}

TEST(Overlay, OfRarnMarksTheParentAndWhatCoversIt) {
  const auto tints = computeTints("rarn");
  EXPECT_GT(tints[0].r, 5 * tints[0].g) << "red";
  EXPECT_EQ(tints[1], tints[2]);
  EXPECT_NE(tints[0], tints[1]);
}

TEST(Overlay, RefusesUnknownNames) {
  try {
    findOverlay("magic");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("bias, level, node, rarn"));
  }
}

}  // namespace
}  // namespace hlodbench
