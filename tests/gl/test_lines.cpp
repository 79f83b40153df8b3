// What a window needs of the renderer: lines over a picture, another size, and showing elsewhere.
#include "gl_fixture.h"
#include "gl_scenes.h"
#include "hlod/render/line_drawing.h"
#include "hlod/render/renderer.h"

namespace hlodbench {
namespace {

using namespace hlodbench::testing;

constexpr LineDrawing::Color kGreen{0, 255, 0};

class LinesTest : public GlTest {
 protected:
  // A white cube in the middle of the picture, whose edge is 2.
  LinesTest() { scene_.addBox({{-1, -1, -1}, {1, 1, 1}}); }

  static Camera makeViewer(int width, int height) {
    return makeCamera(makeLens(width, height), lookAt({0.0, 0.0, 6.0}, {0.0, 0.0, 0.0}));
  }
  static int countGreen(const Image& image, int least) {
    int green = 0;
    for (std::size_t i = 0; i < image.pixels.size(); i += 4)
      green += image.pixels[i + 1] >= least && image.pixels[i] < 60 && image.pixels[i + 2] < 60;
    return green;
  }
  // A line from left to right, this far before the cube's middle.
  static Image drawLine(Renderer& renderer, const Camera& camera, double z) {
    LineDrawing lines;
    renderer.beginFrame(camera);
    renderer.drawNode(0);
    lines.addLine({-1.0, 0.0, z}, {1.0, 0.0, z}, kGreen);
    lines.draw(camera);
    return renderer.readColor();
  }

  FlatHierarchy scene_;
};

TEST_F(LinesTest, LinesBeforeThePictureAreFullAndThoseBehindFaint) {
  const Camera camera = makeViewer(160, 120);
  Renderer renderer(scene_.hierarchy, 160, 120);
  EXPECT_GT(countGreen(drawLine(renderer, camera, 2.0), 250), 30);
  const Image behind = drawLine(renderer, camera, -2.0);
  EXPECT_EQ(countGreen(behind, 250), 0);
  renderer.beginFrame(camera);
  renderer.drawNode(0);
  EXPECT_NE(behind.pixels, renderer.readColor().pixels);
}

TEST_F(LinesTest, AFrameAfterLinesIsAsWithoutThem) {
  const Camera camera = makeViewer(160, 120);
  Renderer renderer(scene_.hierarchy, 160, 120);
  const auto draw = [&] {
    renderer.beginFrame(camera);
    renderer.drawNode(0);
    renderer.drawBox(0);
    return renderer.readColor();
  };
  const Image before = draw();
  drawLine(renderer, camera, 2.0);
  EXPECT_EQ(draw().pixels, before.pixels);
}

TEST_F(LinesTest, AFrustumSurroundsWhatItsCameraSees) {
  // seen by its own camera, the frustum's edges lie on the picture's border
  const Camera camera = makeViewer(160, 120);
  Renderer renderer(scene_.hierarchy, 160, 120);
  LineDrawing lines;
  renderer.beginFrame(camera);
  lines.addFrustum(camera, 10.0, kGreen);
  lines.draw(camera);
  const Image image = renderer.readColor();
  for (int y = 4; y < 116; ++y)
    for (int x = 4; x < 156; ++x)
      ASSERT_NE(image.pixels[4 * (160 * static_cast<std::size_t>(y) + x)], 0) << x << ' ' << y;
}

TEST_F(LinesTest, ResizedItDrawsAsOneOfThatSize) {
  Renderer renderer(scene_.hierarchy, 160, 120);
  Renderer other(scene_.hierarchy, 97, 61);
  renderer.resize(97, 61);
  const Camera camera = makeViewer(97, 61);
  for (Renderer* each : {&renderer, &other}) {
    each->beginFrame(camera);
    each->drawNode(0);
  }
  const Image image = renderer.readColor();
  EXPECT_EQ(image.width, 97);
  EXPECT_EQ(image.height, 61);
  EXPECT_EQ(image.pixels, other.readColor().pixels);
}

TEST_F(LinesTest, IsShownInItsPlaceAndLeavesWritingOn) {
  const Camera camera = makeViewer(40, 30);
  Renderer renderer(scene_.hierarchy, 40, 30);
  Framebuffer window(100, 80);
  window.bind();
  glClearColor(1.0f, 0.0f, 0.0f, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT);
  renderer.beginFrame(camera);
  renderer.drawNode(0);
  renderer.drawBox(0);  // masks all writing
  const Image drawn = renderer.readColor();
  GLint target = 0;
  window.bind();
  glGetIntegerv(GL_FRAMEBUFFER_BINDING, &target);
  renderer.show(static_cast<GLuint>(target), 7, 11, 40, 30);
  const Image shown = window.readColor();
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 100; ++x) {
      const int column = x - 7, row = y - (80 - 11 - 30);
      const bool inside = column >= 0 && column < 40 && row >= 0 && row < 30;
      const std::uint8_t* pixel = &shown.pixels[4 * (std::size_t{100} * y + x)];
      if (inside)
        ASSERT_TRUE(
            std::equal(pixel, pixel + 3, &drawn.pixels[4 * (std::size_t{40} * row + column)]));
      else
        ASSERT_EQ(std::vector<int>(pixel, pixel + 3), (std::vector<int>{255, 0, 0}));
    }
  glClearColor(0.0f, 0.0f, 1.0f, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT);
  EXPECT_EQ(window.readColor().pixels[2], 255);
}

}  // namespace
}  // namespace hlodbench
