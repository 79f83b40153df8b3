// What nodes look like: their normals and colours, and which of their faces are drawn.
#include "gl_fixture.h"
#include "gl_scenes.h"
#include "hlod/render/renderer.h"
#include "hlod/tree/octahedral.h"

namespace hlodbench {
namespace {

using namespace hlodbench::testing;

constexpr int kSize = 64;

class Faces : public GlTest {
 protected:
  static Camera lookFrom(const glm::dvec3& eye) {
    return makeCamera(makeLens(kSize, kSize), lookAt(eye, {0.0, 0.0, 0.0}));
  }
  static glm::vec3 middle(const Image& image) {
    const std::uint8_t* p = &image.pixels[4 * (kSize / 2 * kSize + kSize / 2)];
    return glm::vec3(p[0], p[1], p[2]) / 255.0f;
  }
  // As the shader says: a sun, the sky and the ground.
  static glm::vec3 light(const glm::vec3& color, const glm::vec3& n) {
    const glm::vec3 sky =
        glm::mix(glm::vec3(0.20f, 0.17f, 0.15f), glm::vec3(0.42f, 0.50f, 0.62f), 0.5f + 0.5f * n.y);
    const float sun = std::max(0.0f, glm::dot(n, glm::vec3(0.408f, 0.816f, 0.408f)));
    return glm::min(glm::sqrt(color * (sky + glm::vec3(0.72f, 0.66f, 0.55f) * sun)), 1.0f);
  }
  static int countDifferent(const Image& a, const Image& b) {
    int different = 0;
    for (std::size_t i = 0; i < a.pixels.size(); i += 4)
      different += std::equal(&a.pixels[i], &a.pixels[i] + 4, &b.pixels[i]) ? 0 : 1;
    return different;
  }
  static Image draw(Renderer& renderer, const Camera& camera, NodeId node, Shading shading) {
    renderer.beginFrame(camera, shading);
    renderer.setTint({0.5f, 0.5f, 0.5f});
    renderer.drawNode(node);
    return renderer.readColor();
  }
};

TEST_F(Faces, HaveTheirObjectsColourAndTheLightOfTheirNormal) {
  std::mt19937 random(1);
  std::normal_distribution<float> normal;
  FlatHierarchy flat;
  const std::vector<glm::vec3> corners{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  constexpr NodeId kNodes = 400;
  for (NodeId i = 0; i < kNodes; ++i) {
    flat.normal = encodeOctahedral({normal(random), normal(random), normal(random)});
    flat.add(corners, {{0, 1, 2}, {0, 2, 3}},
             {random() % 256, random() % 256, random() % 256, 255});
  }
  Renderer renderer(flat.hierarchy, kSize, kSize);
  for (NodeId i = 0; i < kNodes; ++i) {
    const glm::vec3 color = flat.hierarchy.objects[i].color;
    const auto& code = flat.hierarchy.vertices(flat.hierarchy.node(i))[0].normal;
    const glm::vec3 n = decodeOctahedral({code[0], code[1]});
    for (const bool fromBehind : {false, true}) {
      const Camera camera = lookFrom({0.0, 0.0, fromBehind ? -3.0 : 3.0});
      const glm::vec3 expected = light(color, fromBehind ? -n : n);
      const glm::vec3 seen = middle(draw(renderer, camera, i, Shading::kLit));
      EXPECT_LT(glm::length(seen - expected), 0.01f) << i << (fromBehind ? " behind" : "");
      // the object's index, and a tint instead of the colour
      EXPECT_EQ(middle(draw(renderer, camera, i, Shading::kObjects)) * 255.0f,
                glm::vec3(i % 256, i / 256, 0));
      const float lightOnly =
          glm::mix(0.25f, 0.5f, 0.5f + 0.5f * (fromBehind ? -n : n).y) +
          0.5f * std::max(0.0f, glm::dot(fromBehind ? -n : n, glm::vec3(0.408f, 0.816f, 0.408f)));
      EXPECT_LT(glm::length(middle(draw(renderer, camera, i, Shading::kTinted)) -
                            glm::sqrt(glm::vec3(0.5f * lightOnly))),
                0.01f);
    }
  }
}

TEST_F(Faces, AtTheBackAreLeftOutWhereAskedForAndWoundConsistently) {
  FlatHierarchy flat;
  const NodeId consistent = flat.addBox({{-1, -1, -1}, {1, 1, 1}}, {200, 10, 10, 255});
  const NodeId soup = flat.addBox({{-1, -1, -1}, {1, 1, 1}}, {10, 200, 10, 255});
  flat.hierarchy.nodes[consistent].flags = kConsistentWinding;
  Renderer both(flat.hierarchy, kSize, kSize);
  Renderer front(flat.hierarchy, kSize, kSize, {.culling = FaceCulling::kBackWhereConsistent});
  const Camera outside = lookFrom({2.0, 3.0, 4.0});
  const Camera inside = lookFrom({0.1, 0.2, 0.3});
  for (const Shading shading : {Shading::kLit, Shading::kObjects, Shading::kTinted}) {
    for (const NodeId node : {consistent, soup}) {
      const Image picture = draw(both, outside, node, shading);
      EXPECT_GT(countCovered(picture), 200);
      // along the outline, a back face may be as near as the front face
      const Image culled = draw(front, outside, node, shading);
      EXPECT_EQ(countCovered(culled), countCovered(picture));
      EXPECT_LT(countDifferent(culled, picture), countCovered(picture) / 20);
      EXPECT_EQ(countCovered(draw(both, inside, node, shading)), kSize * kSize);
    }
    EXPECT_EQ(countCovered(draw(front, inside, consistent, shading)), 0);
    EXPECT_EQ(countCovered(draw(front, inside, soup, shading)), kSize * kSize);
  }
  // whatever was drawn before
  front.beginFrame(inside);
  front.drawNode(consistent);
  front.drawBox(soup);
  front.drawNode(consistent);
  EXPECT_EQ(countCovered(front.readColor()), 0);
  front.drawBox(consistent);
  front.drawNode(soup);
  EXPECT_EQ(countCovered(front.readColor()), kSize * kSize);
}

TEST_F(Faces, OfABlockThatIsNotAsItsChecksumSaysAreRefused) {
  FlatHierarchy flat;
  for (int i = 0; i < 3; ++i) flat.addBox({{-1, -1, -1}, {1, 1, 1}});
  ++flat.hierarchy.nodes[1].geometryHash;
  try {
    Renderer renderer(flat.hierarchy, kSize, kSize);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("node 1: damaged"), std::string::npos) << error.what();
  }
}

TEST_F(Faces, OfManyNodesDrawnAtOnceAreThoseOfOneAfterTheOther) {
  std::mt19937 random(3);
  FlatHierarchy flat;
  constexpr NodeId kNodes = 60;
  std::vector<NodeId> order;
  Aabb box;
  for (NodeId i = 0; i < kNodes; ++i) {
    // open, so that faces of both sides are seen; some in the same place: the last one is on top
    if (i % 3 != 2) box = makeRandomBox(random);
    const glm::vec3 low = box.min, high = box.max;
    flat.add({low, {high.x, low.y, low.z}, {low.x, high.y, low.z}, high},
             {{0, 1, 2}, {1, 3, 2}, {0, 2, 3}},
             {random() % 256, random() % 256, random() % 256, 255});
    flat.hierarchy.nodes[i].flags = random() % 2;
    order.push_back(i);
  }
  for (const FaceCulling culling : {FaceCulling::kNone, FaceCulling::kBackWhereConsistent}) {
    Renderer renderer(flat.hierarchy, kSize, kSize, {.culling = culling});
    for (int round = 0; round < 20; ++round) {
      std::shuffle(order.begin(), order.end(), random);
      const Camera camera = makeCamera(makeLens(kSize, kSize), makeRandomPose(random));
      const Shading shading = round % 2 == 0 ? Shading::kLit : Shading::kObjects;
      renderer.beginFrame(camera, shading);
      for (const NodeId id : order) renderer.drawNode(id);
      const Image expected = renderer.readColor();
      renderer.beginFrame(camera, shading);
      renderer.drawBox(order[0]);
      const std::span<const NodeId> all(order);
      renderer.drawNodes(all.first(17));
      renderer.drawNodes({});
      renderer.drawNodes(all.subspan(17));
      EXPECT_EQ(renderer.readColor().pixels, expected.pixels);
    }
  }
}

// More vertices than 16-bit indices reach.
TEST_F(Faces, OfLargeNodesAreDrawnWithWideIndices) {
  constexpr unsigned kCells = 270;
  std::vector<glm::vec3> points;
  std::vector<glm::uvec3> triangles;
  for (unsigned v = 0; v <= kCells; ++v)
    for (unsigned u = 0; u <= kCells; ++u) {
      points.emplace_back(4.0f * u / kCells - 2.0f, 4.0f * v / kCells - 2.0f, 0.0f);
      const unsigned at = v * (kCells + 1) + u;
      if (u < kCells && v < kCells) {
        triangles.emplace_back(at, at + 1, at + kCells + 2);
        triangles.emplace_back(at, at + kCells + 2, at + kCells + 1);
      }
    }
  FlatHierarchy flat;
  flat.addBox({{-1, -1, -1}, {1, 1, 1}});
  const NodeId large = flat.add(points, triangles);
  ASSERT_FALSE(flat.hierarchy.node(large).hasNarrowIndices());
  Renderer renderer(flat.hierarchy, kSize, kSize);
  EXPECT_EQ(countCovered(draw(renderer, lookFrom({0, 0, 2}), large, Shading::kLit)), kSize * kSize);
}

}  // namespace
}  // namespace hlodbench
