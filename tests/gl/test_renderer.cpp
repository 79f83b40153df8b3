// The renderer against computations on the CPU: what nodes and boxes cover, and what they leave.
#include "gl_fixture.h"
#include "gl_scenes.h"
#include "hlod/render/gl_object.h"
#include "hlod/render/renderer.h"

namespace hlodbench {
namespace {

using namespace hlodbench::testing;

constexpr int kWidth = 320;
constexpr int kHeight = 240;

class RendererTest : public GlTest {
 protected:
  // Pixels of the node's box that pass the depth test now.
  static GLuint countBoxPixels(Renderer& renderer, NodeId node) {
    const GlQuery query;
    glBeginQuery(GL_SAMPLES_PASSED, query);
    renderer.drawBox(node);
    glEndQuery(GL_SAMPLES_PASSED);
    GLuint pixels = 0;
    glGetQueryObjectuiv(query, GL_QUERY_RESULT, &pixels);
    return pixels;
  }

  static std::vector<float> readDepth() {
    std::vector<float> depth(kWidth * kHeight);
    glReadPixels(0, 0, kWidth, kHeight, GL_DEPTH_COMPONENT, GL_FLOAT, depth.data());
    return depth;
  }

  // The share of the way along the ray (of any length) to the triangle; below 0 for a miss. Sets
  // `unsure` when the ray passes so near an edge that rounding decides.
  static double intersect(const glm::dvec3& eye, const glm::dvec3& ray,
                          std::span<const glm::vec3, 3> corners, bool& unsure) {
    const glm::dvec3 a = corners[0], b = corners[1], c = corners[2];
    const glm::dvec3 p = glm::cross(ray, c - a);
    const double determinant = glm::dot(b - a, p);
    const double u = glm::dot(eye - a, p) / determinant;
    const glm::dvec3 q = glm::cross(eye - a, b - a);
    const double v = glm::dot(ray, q) / determinant;
    const double t = glm::dot(c - a, q) / determinant;
    constexpr double kEdge = 0.02;
    const double inside = std::min({u, v, 1.0 - u - v});
    if (!(std::abs(inside) > kEdge)) unsure = true;
    return inside >= 0.0 ? t : -1.0;
  }

  // Through (x, y) of the picture, pixels; pixel centres are at whole numbers here.
  static glm::dvec3 computeRay(const Camera& camera, double x, double y) {
    const double tangent = std::tan(0.5 * camera.lens.fovyRad);
    const double aspect = static_cast<double>(camera.lens.width) / camera.lens.height;
    const glm::dvec3 direction(tangent * aspect * (2.0 * (x + 0.5) / camera.lens.width - 1.0),
                               tangent * (1.0 - 2.0 * (y + 0.5) / camera.lens.height), -1.0);
    return camera.pose.orientation * direction;
  }

  // What the depth buffer has for a point, 0 to 1.
  static double computeDepth(const Camera& camera, const glm::dvec3& point) {
    const glm::dvec4 p = camera.viewProjection * glm::dvec4(point, 1.0);
    return 0.5 * p.z / p.w + 0.5;
  }

  // How much the depth of a triangle's plane changes between a pixel's centre and a point of the
  // grid next to it that OpenGL moves corners to, which has GL_SUBPIXEL_BITS a pixel.
  static double computeSnappingError(const Camera& camera, int x, int y,
                                     std::span<const glm::vec3, 3> corners) {
    GLint bits = 0;
    glGetIntegerv(GL_SUBPIXEL_BITS, &bits);
    const double step = std::ldexp(1.0, -bits);
    const glm::dvec3 normal =
        glm::cross(glm::dvec3(corners[1] - corners[0]), glm::dvec3(corners[2] - corners[0]));
    const auto depthAt = [&](double dx, double dy) {
      const glm::dvec3 ray = computeRay(camera, x + dx, y + dy);
      const glm::dvec3 eye = camera.pose.position;
      const double t = glm::dot(glm::dvec3(corners[0]) - eye, normal) / glm::dot(ray, normal);
      return computeDepth(camera, eye + t * ray);
    };
    return std::abs(depthAt(step, 0) - depthAt(0, 0)) + std::abs(depthAt(0, step) - depthAt(0, 0));
  }
};

TEST_F(RendererTest, BoxesPassAsManyPixelsAsTheirProjectedAreaSays) {
  std::mt19937 random(1);
  FlatHierarchy flat;
  for (int i = 0; i < 400; ++i) flat.addBox(makeRandomBox(random));
  Renderer renderer(flat.hierarchy, kWidth, kHeight);
  int tested = 0;
  int large = 0;
  for (int round = 0; round < 10; ++round) {
    const Camera camera = makeCamera(makeLens(kWidth, kHeight), makeRandomPose(random));
    renderer.beginFrame(camera);
    for (NodeId id = 0; id < flat.hierarchy.nodes.size(); ++id) {
      const Aabb& box = flat.hierarchy.node(id).box;
      if (!canBeQueried(camera, box)) continue;
      const double area = computeProjectedArea(camera, box);
      // The number of pixel centres in a convex shape differs from its area by less than its
      // outline, which is no longer than that of the rectangle around it.
      const double perimeter = computeScreenBounds(camera, box).perimeter();
      EXPECT_NEAR(countBoxPixels(renderer, id), area, 0.5 * perimeter + 2.0) << "box " << id;
      ++tested;
      // what counts each pixel twice, or half of them, cannot pass
      if (area > 2.0 * perimeter) ++large;
    }
  }
  EXPECT_GT(tested, 200);
  EXPECT_GT(large, 50);
}

TEST_F(RendererTest, ABoxPassesEachPixelThatItCoversOnce) {
  std::mt19937 random(2);
  FlatHierarchy flat;
  for (int i = 0; i < 100; ++i) flat.addBox(makeRandomBox(random));
  Renderer renderer(flat.hierarchy, kWidth, kHeight);
  int tested = 0;
  for (int round = 0; round < 8; ++round) {
    const Camera camera = makeCamera(makeLens(kWidth, kHeight), makeRandomPose(random));
    for (NodeId id = 0; id < flat.hierarchy.nodes.size(); ++id) {
      if (!canBeQueried(camera, flat.hierarchy.node(id).box)) continue;
      renderer.beginFrame(camera);
      const int passed = static_cast<int>(countBoxPixels(renderer, id));
      renderer.drawNode(id);  // the same box as geometry, both faces
      // a pixel centre that an edge goes through may belong to the other side of the silhouette
      EXPECT_NEAR(passed, countCovered(renderer.readColor()), 2) << "box " << id;
      ++tested;
    }
  }
  EXPECT_GT(tested, 50);
}

TEST_F(RendererTest, AFlatBoxInThePlaneOfItsGeometryPassesAllItsPixels) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
  constexpr int kCells = 12;
  int tested = 0;
  for (int round = 0; round < 60; ++round) {
    // a wall of many triangles, in the plane across one of the axes
    const int axis = round % 3;
    const float place = 3.0f * uniform(random);
    FlatHierarchy flat;
    std::vector<glm::vec3> points;
    std::vector<glm::uvec3> triangles;
    for (int v = 0; v <= kCells; ++v)
      for (int u = 0; u <= kCells; ++u) {
        glm::vec3 p(place);
        p[(axis + 1) % 3] = 8.0f * u / kCells - 4.0f;
        p[(axis + 2) % 3] = 8.0f * v / kCells - 4.0f;
        points.push_back(p);
      }
    for (unsigned v = 0; v < kCells; ++v)
      for (unsigned u = 0; u < kCells; ++u) {
        const unsigned at = v * (kCells + 1) + u;
        triangles.emplace_back(at, at + 1, at + kCells + 2);
        triangles.emplace_back(at, at + kCells + 2, at + kCells + 1);
      }
    const NodeId wall = flat.add(points, triangles);
    Renderer renderer(flat.hierarchy, kWidth, kHeight);
    for (int view = 0; view < 10; ++view) {
      const glm::dvec3 eye(6 * uniform(random), 6 * uniform(random), 6 * uniform(random));
      const glm::dvec3 target(uniform(random), uniform(random), uniform(random));
      const Camera camera = makeCamera(makeLens(kWidth, kHeight), lookAt(eye, target));
      if (!canBeQueried(camera, flat.hierarchy.node(wall).box)) continue;
      renderer.beginFrame(camera);
      renderer.drawNode(wall);
      const int covered = countCovered(renderer.readColor());
      // along the outline the cells' corners are rounded, so that it is not quite the box's
      EXPECT_NEAR(countBoxPixels(renderer, wall), covered, 5 + 0.001 * covered)
          << "eye " << eye.x << ' ' << eye.y << ' ' << eye.z;
      if (covered > 100) ++tested;
    }
  }
  EXPECT_GT(tested, 100);
}

TEST_F(RendererTest, BoxesLeaveNoTrace) {
  std::mt19937 random(4);
  FlatHierarchy flat;
  for (int i = 0; i < 60; ++i)
    flat.addBox(makeRandomBox(random), {random() % 256, random() % 256, random() % 256, 255});
  Renderer renderer(flat.hierarchy, kWidth, kHeight);
  for (int round = 0; round < 10; ++round) {
    const Camera camera = makeCamera(makeLens(kWidth, kHeight), makeRandomPose(random));
    renderer.beginFrame(camera);
    for (NodeId id = 0; id < 30; ++id) renderer.drawNode(id);
    const Image color = renderer.readColor();
    const std::vector<float> depth = readDepth();
    GLuint passed = 0;
    for (NodeId id = 0; id < 60; ++id) passed += countBoxPixels(renderer, id);
    EXPECT_GT(passed, 0u);
    EXPECT_EQ(renderer.readColor().pixels, color.pixels);
    EXPECT_EQ(readDepth(), depth);
    // and what comes after them is drawn as if they had not been there
    for (NodeId id = 30; id < 60; ++id) renderer.drawNode(id);
    const Image after = renderer.readColor();
    renderer.beginFrame(camera);
    for (NodeId id = 0; id < 60; ++id) renderer.drawNode(id);
    EXPECT_EQ(renderer.readColor().pixels, after.pixels);
  }
}

TEST_F(RendererTest, NodesCoverThePixelsThatRaysHitAndTheNearestHitDecidesTheDepth) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
  constexpr int kTriangles = 24;
  FlatHierarchy flat;
  std::vector<glm::vec3> corners;
  for (int i = 0; i < kTriangles; ++i) {
    const glm::vec3 centre(4 * uniform(random), 3 * uniform(random), -7 + 3 * uniform(random));
    for (int k = 0; k < 3; ++k)
      corners.push_back(centre +
                        2.5f * glm::vec3(uniform(random), uniform(random), uniform(random)));
    flat.add({corners.end() - 3, corners.end()}, {{0, 1, 2}});
  }
  Renderer renderer(flat.hierarchy, kWidth, kHeight);
  int sure = 0;
  for (int round = 0; round < 4; ++round) {
    const glm::dvec3 eye(2 * uniform(random), 2 * uniform(random), 2 * uniform(random));
    const Camera camera = makeCamera(makeLens(kWidth, kHeight), lookAt(eye, {0, 0, -7}));
    renderer.beginFrame(camera);
    for (NodeId id = 0; id < kTriangles; ++id) renderer.drawNode(id);
    const Image image = renderer.readColor();
    const std::vector<float> depth = readDepth();
    for (int y = 0; y < kHeight; y += 2)
      for (int x = 0; x < kWidth; x += 2) {
        const glm::dvec3 ray = computeRay(camera, x, y);
        double nearest = 1e300;
        std::span<const glm::vec3, 3> triangle(&corners[0], 3);
        bool unsure = false;
        for (int i = 0; i < kTriangles; ++i) {
          const std::span<const glm::vec3, 3> candidate(&corners[3 * i], 3);
          const double t = intersect(eye, ray, candidate, unsure);
          if (t <= 0.0 || t >= nearest) continue;
          nearest = t;
          triangle = candidate;
        }
        if (unsure) continue;
        ++sure;
        ASSERT_EQ(isCovered(image, x, y), nearest < 1e300) << "pixel " << x << ' ' << y;
        if (nearest == 1e300) continue;
        ASSERT_NEAR(depth[(kHeight - 1 - y) * kWidth + x],
                    computeDepth(camera, eye + nearest * ray),
                    1e-5 + computeSnappingError(camera, x, y, triangle));
      }
  }
  EXPECT_GT(sure, kWidth * kHeight / 4);
}

TEST_F(RendererTest, TheNearerNodeIsOnTopInEitherOrderAndRowsComeFromTheTop) {
  FlatHierarchy flat;
  const NodeId red = flat.addBox({{-1, 0.2f, -6}, {1, 3, -5}}, {255, 0, 0, 255});
  const NodeId green = flat.addBox({{-1, 0.1f, -9}, {1, 3, -8}}, {0, 255, 0, 255});
  Renderer renderer(flat.hierarchy, kWidth, kHeight);
  const Camera camera = makeCamera(makeLens(kWidth, kHeight), Pose{});
  for (const bool redFirst : {true, false}) {
    renderer.beginFrame(camera);
    renderer.drawNode(redFirst ? red : green);
    renderer.drawNode(redFirst ? green : red);
    const Image image = renderer.readColor();
    ASSERT_EQ(image.width, kWidth);
    ASSERT_EQ(image.height, kHeight);
    // the boxes are above the eye, so in the upper half, whose rows come first
    const int top = kHeight / 2 - 60;
    EXPECT_TRUE(isCovered(image, kWidth / 2, top));
    EXPECT_FALSE(isCovered(image, kWidth / 2, kHeight - 1 - top));
    const std::uint8_t* pixel = &image.pixels[4 * (top * kWidth + kWidth / 2)];
    EXPECT_GT(pixel[0], 100);
    EXPECT_EQ(pixel[1], 0);
  }
}

TEST_F(RendererTest, EveryFrameStartsEmpty) {
  FlatHierarchy flat;
  const NodeId box = flat.addBox({{-1, -1, -6}, {1, 1, -5}});
  Renderer renderer(flat.hierarchy, kWidth, kHeight);
  const Camera camera = makeCamera(makeLens(kWidth, kHeight), Pose{});
  GLuint first = 0;
  for (int frame = 0; frame < 3; ++frame) {
    renderer.beginFrame(camera);
    EXPECT_EQ(countCovered(renderer.readColor()), 0);
    const GLuint passed = countBoxPixels(renderer, box);
    if (frame == 0) first = passed;
    EXPECT_EQ(passed, first);
    renderer.drawNode(box);
    if (frame == 1) countBoxPixels(renderer, box);  // the next clear follows a box: masks are off
  }
}

}  // namespace
}  // namespace hlodbench
