#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gui/scene_pane.h"
#include "hlod/core/image.h"
#include "hlod/render/line_drawing.h"

namespace hlodbench {

// Whose boxes are drawn over the picture.
enum class Boxes { kNone, kDrawn, kQueried, kCulled, kAll };

// A part of the window, pixels of its framebuffer from the lower left.
struct Area {
  int x = 0, y = 0, width = 0, height = 0;
};

// The panes of a window, one or two beside each other, on one camera and one renderer.
class Stage {
 public:
  // What a user sees of the nodes.
  struct Look {
    std::string overlay;  // see listOverlays(); "": the objects' colours
    Boxes boxes = Boxes::kNone;
  };

  // All must outlive the stage. settings: one for each pane, at least one.
  Stage(const Hierarchy& hierarchy, const Lens& lens, const RendererOptions& options,
        std::span<const StrategyInfo> strategies, const std::vector<PaneSettings>& settings);

  [[nodiscard]] std::size_t paneCount() const { return panes_.size(); }
  [[nodiscard]] ScenePane& pane(std::size_t i) { return *panes_[i]; }
  // The second pane begins with these settings.
  void split(const PaneSettings& second);
  void join();

  // Keeps what was drawn in the last frame, to be looked at from elsewhere; no strategy is asked
  // until it is let go.
  void freeze();
  void letGo() { frozen_.reset(); }
  [[nodiscard]] bool isFrozen() const { return frozen_.has_value(); }

  // Draws every pane with the camera into its part of the area, as large as its aspect allows.
  void render(const Camera& camera, const Area& area);
  // Where a pane is.
  [[nodiscard]] Area paneArea(const Area& whole, std::size_t i) const;
  // The panes beside each other as the next render() draws them, without what else is in the
  // window.
  void requestPicture() { wantsPicture_ = true; }
  std::optional<Image> takePicture() { return std::exchange(picture_, std::nullopt); }
  // The point of the scene under a point of the window (pixels from the lower left) in the last
  // frame; nothing where none is.
  [[nodiscard]] std::optional<glm::dvec3> pick(const glm::dvec2& point, const Area& area) const;

  Look look;

 private:
  struct FrozenPane {
    Front front;
    Trace trace;
  };
  struct Frozen {
    Camera camera;
    std::vector<FrozenPane> panes;
  };

  void drawFront(const Camera& camera, const Front& front);
  void drawTinted(const Camera& camera, const Front& front);
  void drawLines(const Camera& camera, const Trace& trace, Boxes boxes);
  [[nodiscard]] Area pictureArea(const Area& whole, std::size_t i) const;

  const Hierarchy& hierarchy_;
  std::span<const StrategyInfo> strategies_;
  Renderer renderer_;
  LineDrawing lines_;
  std::vector<std::unique_ptr<ScenePane>> panes_;
  std::optional<Frozen> frozen_;
  Camera camera_;  // of the last frame
  bool wantsPicture_ = false;
  std::optional<Image> picture_;
};

}  // namespace hlodbench
