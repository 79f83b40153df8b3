#include "gui/stage.h"

#include <algorithm>
#include <cmath>

#include "overlay.h"
#include "view/node_boxes.h"
#include "view/picking.h"

namespace hlodbench {
namespace {

constexpr LineDrawing::Color kDrawnColor{255, 255, 255};
constexpr LineDrawing::Color kVisibleColor{60, 220, 90};
constexpr LineDrawing::Color kOccludedColor{235, 60, 50};
constexpr LineDrawing::Color kCulledColor{90, 120, 255};
constexpr LineDrawing::Color kFrustumColor{255, 210, 40};
constexpr double kFrustumShare = 0.35;  // of the scene's size: how far a frustum within it goes

constexpr int kGap = 2;  // between panes, pixels

// The largest area of the aspect within another one, in its middle.
Area fit(const Area& area, double aspect) {
  Area fitted = area;
  fitted.width = std::min(area.width, static_cast<int>(std::lround(area.height * aspect)));
  fitted.height = std::min(area.height, static_cast<int>(std::lround(area.width / aspect)));
  fitted.x += (area.width - fitted.width) / 2;
  fitted.y += (area.height - fitted.height) / 2;
  return fitted;
}

// Images of one height beside each other.
Image joinImages(const std::vector<Image>& images) {
  Image joined{0, images[0].height, {}};
  for (const Image& image : images) joined.width += image.width;
  for (int row = 0; row < joined.height; ++row)
    for (const Image& image : images) {
      const auto begin = image.pixels.begin() + std::ptrdiff_t{4} * image.width * row;
      joined.pixels.insert(joined.pixels.end(), begin, begin + std::ptrdiff_t{4} * image.width);
    }
  return joined;
}

}  // namespace

Stage::Stage(const Hierarchy& hierarchy, const Lens& lens, const RendererOptions& options,
             std::span<const StrategyInfo> strategies, const std::vector<PaneSettings>& settings)
    : hierarchy_(hierarchy),
      strategies_(strategies),
      renderer_(hierarchy, lens.width, lens.height, options) {
  for (const PaneSettings& one : settings)
    panes_.push_back(std::make_unique<ScenePane>(hierarchy_, renderer_, strategies_, one));
}

void Stage::split(const PaneSettings& second) {
  join();
  panes_.push_back(std::make_unique<ScenePane>(hierarchy_, renderer_, strategies_, second));
}

void Stage::join() {
  letGo();
  panes_.resize(1);
}

void Stage::freeze() {
  frozen_.emplace(Frozen{camera_, {}});
  for (const auto& pane : panes_) frozen_->panes.push_back({pane->front(), pane->trace()});
}

Area Stage::paneArea(const Area& whole, std::size_t i) const {
  const int count = static_cast<int>(panes_.size());
  const int width = std::max(1, (whole.width - kGap * (count - 1)) / count);
  return {whole.x + static_cast<int>(i) * (width + kGap), whole.y, width, whole.height};
}

Area Stage::pictureArea(const Area& whole, std::size_t i) const {
  return fit(paneArea(whole, i), static_cast<double>(camera_.lens.width) / camera_.lens.height);
}

void Stage::render(const Camera& camera, const Area& area) {
  camera_ = camera;
  renderer_.resize(camera.lens.width, camera.lens.height);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glClearColor(0.1f, 0.1f, 0.1f, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT);
  const Aabb& box = hierarchy_.node(kRoot).box;
  const glm::dvec3 center = 0.5 * (glm::dvec3(box.min) + glm::dvec3(box.max));
  std::vector<Image> images;
  for (std::size_t i = 0; i < panes_.size(); ++i) {
    ScenePane& pane = *panes_[i];
    if (frozen_) {
      drawFront(camera, frozen_->panes[i].front);
      const double length = std::max(kFrustumShare * box.diagonal(),
                                     glm::distance(frozen_->camera.pose.position, center));
      lines_.addFrustum(frozen_->camera, std::min(frozen_->camera.lens.farPlane, length),
                        kFrustumColor);
      // from outside, what was queried is what there is to see
      const Boxes boxes = look.boxes == Boxes::kNone ? Boxes::kQueried : look.boxes;
      drawLines(camera, frozen_->panes[i].trace, boxes);
    } else {
      pane.render(camera);
      if (!look.overlay.empty()) drawTinted(camera, pane.front());
      drawLines(camera, pane.trace(), look.boxes);
    }
    if (wantsPicture_) images.push_back(renderer_.readColor());
    const Area place = pictureArea(area, i);
    renderer_.show(0, place.x, place.y, place.width, place.height);
  }
  if (wantsPicture_) picture_ = joinImages(images);
  wantsPicture_ = false;
}

void Stage::drawFront(const Camera& camera, const Front& front) {
  if (!look.overlay.empty()) {
    drawTinted(camera, front);
    return;
  }
  renderer_.beginFrame(camera);
  std::vector<NodeId> nodes;
  for (const DrawnNode& drawn : front.nodes) nodes.push_back(drawn.node);
  renderer_.drawNodes(nodes);
}

void Stage::drawTinted(const Camera& camera, const Front& front) {
  const std::vector<glm::vec3> tints = findOverlay(look.overlay).computeTints(hierarchy_, front);
  renderer_.beginFrame(camera, Shading::kTinted);
  for (std::size_t i = 0; i < front.nodes.size(); ++i) {
    renderer_.setTint(tints[i]);
    renderer_.drawNodes({&front.nodes[i].node, 1});
  }
}

void Stage::drawLines(const Camera& camera, const Trace& trace, Boxes boxes) {
  if (boxes != Boxes::kNone) {
    const NodeBoxes nodes = collectBoxes(trace);
    const auto add = [&](const std::vector<NodeId>& ids, const LineDrawing::Color& color) {
      for (const NodeId id : ids) lines_.addBox(hierarchy_.node(id).box, color);
    };
    const bool all = boxes == Boxes::kAll;
    if (all || boxes == Boxes::kDrawn) add(nodes.drawn, kDrawnColor);
    if (all || boxes == Boxes::kCulled) add(nodes.culled, kCulledColor);
    if (all || boxes == Boxes::kQueried) {
      add(nodes.visible, kVisibleColor);
      add(nodes.occluded, kOccludedColor);
    }
  }
  lines_.draw(camera);
}

std::optional<glm::dvec3> Stage::pick(const glm::dvec2& point, const Area& area) const {
  for (std::size_t i = 0; i < panes_.size(); ++i) {
    const Area place = pictureArea(area, i);
    const glm::dvec2 share = (point - glm::dvec2(place.x, place.y)) /
                             glm::dvec2(std::max(1, place.width), std::max(1, place.height));
    if (share.x < 0.0 || share.y < 0.0 || share.x >= 1.0 || share.y >= 1.0) continue;
    const DepthImage depth = renderer_.readDepth();
    const double x = share.x * depth.width;
    const double y = (1.0 - share.y) * depth.height;
    const int column = std::clamp(static_cast<int>(x), 0, depth.width - 1);
    const int row = std::clamp(static_cast<int>(y), 0, depth.height - 1);
    const float found = depth.depth[static_cast<std::size_t>(row) * depth.width + column];
    if (!std::isfinite(found)) return std::nullopt;
    return computePointAt(camera_, x, y, found);
  }
  return std::nullopt;
}

}  // namespace hlodbench
