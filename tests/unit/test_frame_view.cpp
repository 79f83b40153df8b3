// What predictors and strategies see: the same values as the program's own, and only nodes that are
// there.
#include <gmock/gmock.h>

#include <random>

#include "tiny_tree.h"
#include "traversals/scene_view.h"

namespace hlodbench {
namespace {

using testing::HasSubstr;

TinyTree makeTree() {
  TinyTree tree;
  tree.addChildren(0, 4);
  tree.addChildren(2, 3);
  tree.setSse(0, 8.0);
  tree.setSse(2, 3.0);
  return tree;
}

TEST(FrameView, HasTheProgramsOwnValuesToTheLastBit) {
  TinyTree tree = makeTree();
  TraversalOptions options;
  options.tau = 0.7;
  options.bias = {0.5, 0.3, 3.0};
  SceneView scene(tree.hierarchy, options);
  std::mt19937 random(5);
  const auto draw = [&](double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
  };
  for (int frame = 0; frame < 50; ++frame) {
    Lens lens = makeTestLens();
    lens.fovyRad = draw(0.3, 1.5);
    const glm::dquat turned =
        glm::normalize(glm::dquat(1.0, draw(-0.2, 0.2), draw(-0.2, 0.2), draw(-0.2, 0.2)));
    const Camera camera = makeCamera(lens, {{draw(-3, 3), draw(-3, 3), draw(-13, 3)}, turned});
    scene.beginFrame(camera);
    const plugin::FrameView& view = scene.frame();
    EXPECT_EQ(view.frame(), frame);
    for (NodeId id = 0; id < view.nodeCount(); ++id) {
      const Node& node = tree.hierarchy.node(id);
      EXPECT_EQ(view.computeDistance(id), computeDistance(camera, node.box));
      EXPECT_EQ(view.computeSse(id), computeScreenError(camera, node.box, node.error));
      EXPECT_EQ(view.isInsideFrustum(id), Frustum(camera).intersects(node.box));
      EXPECT_EQ(view.isCutByNearPlane(id), isCutByNearPlane(camera, node.box));
      if (!view.isCutByNearPlane(id)) {
        EXPECT_EQ(view.computeProjectedArea(id), computeProjectedArea(camera, node.box));
      }
    }
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(view.camera().eye[axis], camera.pose.position[axis]);
      EXPECT_EQ(view.camera().forward[axis], camera.forward()[axis]);
    }
    const glm::dvec4 clip = camera.viewProjection * glm::dvec4(1, 2, 3, 1);
    const double* m = view.camera().viewProjection;
    for (int row = 0; row < 4; ++row)
      EXPECT_NEAR(m[row] + 2 * m[4 + row] + 3 * m[8 + row] + m[12 + row], clip[row], 1e-12);
  }
  EXPECT_EQ(scene.frame().tau(), 0.7);
  EXPECT_EQ(scene.frame().computeBias(0.2), computeBias(0.2, options.bias));
}

TEST(FrameView, HasTheNodesOfTheHierarchy) {
  const TinyTree tree = makeTree();
  SceneView scene(tree.hierarchy, {});
  ASSERT_EQ(scene.frame().nodeCount(), 0u) << "before the first frame there is nothing";
  const Camera camera = makeTestCamera();
  scene.beginFrame(camera);
  const plugin::FrameView& view = scene.frame();
  ASSERT_EQ(view.nodeCount(), 8u);
  for (NodeId id = 0; id < 8; ++id) {
    const Node& ours = tree.hierarchy.node(id);
    const plugin::Node& node = view.node(id);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(node.boxMin[axis], ours.box.min[axis]);
      EXPECT_EQ(node.boxMax[axis], ours.box.max[axis]);
    }
    EXPECT_EQ(node.error, ours.error);
    EXPECT_EQ(node.level, ours.level);
    EXPECT_EQ(node.parent, ours.parent);
    EXPECT_EQ(node.firstChild, ours.firstChild);
    EXPECT_EQ(node.childCount, ours.childCount);
    EXPECT_EQ(node.triangleCount, ours.triangleCount());
    EXPECT_EQ(node.isLeaf(), ours.isLeaf());
  }
}

TEST(FrameView, RefusesANodeThatThereIsNot) {
  const TinyTree tree = makeTree();
  SceneView scene(tree.hierarchy, {});
  const Camera camera = makeTestCamera();
  scene.beginFrame(camera);
  const plugin::FrameView& view = scene.frame();
  const auto check = [&](auto ask) {
    for (const NodeId id : {8u, 9u, kNoNode}) {
      try {
        ask(id);
        ADD_FAILURE() << "node " << id << " was accepted";
      } catch (const std::out_of_range& error) {
        EXPECT_THAT(error.what(), HasSubstr("node " + std::to_string(id) + ";"));
        EXPECT_THAT(error.what(), HasSubstr("has 8 nodes"));
      }
    }
    EXPECT_NO_THROW(ask(7));
  };
  check([&](NodeId id) { (void)view.node(id); });
  check([&](NodeId id) { (void)view.state(id); });
  check([&](NodeId id) { (void)view.wasVisible(id); });
  check([&](NodeId id) { (void)view.computeDistance(id); });
  check([&](NodeId id) { (void)view.computeSse(id); });
  check([&](NodeId id) { (void)view.computeProjectedArea(id); });
  check([&](NodeId id) { (void)view.isInsideFrustum(id); });
  check([&](NodeId id) { (void)view.isCutByNearPlane(id); });
}

}  // namespace
}  // namespace hlodbench
