#include "view/node_boxes.h"

#include <gmock/gmock.h>

#include "tiny_tree.h"

namespace hlodbench {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

}  // namespace

TEST(NodeBoxes, SortsNodesByWhatBecameOfThem) {
  using Type = TraceEvent::Type;
  Trace trace;
  trace.push_back({.type = Type::kVisit, .node = 0, .inFrustum = true});
  trace.push_back({.type = Type::kQuery, .node = 0});
  trace.push_back({.type = Type::kResult, .node = 0, .pixels = 12});
  trace.push_back({.type = Type::kVisit, .node = 2, .inFrustum = false});
  trace.push_back({.type = Type::kQuery, .node = 1});
  trace.push_back({.type = Type::kDraw, .node = 1});
  trace.push_back({.type = Type::kResult, .node = 1, .pixels = 0});
  trace.push_back({.type = Type::kDraw, .node = 1});  // as without a guard
  const NodeBoxes boxes = collectBoxes(trace);
  EXPECT_THAT(boxes.visible, ElementsAre(0u));
  EXPECT_THAT(boxes.occluded, ElementsAre(1u));
  EXPECT_THAT(boxes.culled, ElementsAre(2u));
  EXPECT_THAT(boxes.drawn, ElementsAre(1u));
  EXPECT_THAT(collectBoxes({}).drawn, IsEmpty());
}

}  // namespace hlodbench
