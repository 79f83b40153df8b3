#include "picture_pass.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "overlay.h"
#include "picture.h"
#include "progress_line.h"

namespace hlodbench {
namespace {

constexpr const char* kReference = "bool";  // the paper's (section 5.3)

// The same nodes twice: as they look, and which object is in front.
struct View {
  Image color, objects;
};

// What a pixel spans at distance 1.
double computePixelSize(const Lens& lens) {
  return 2.0 * std::tan(0.5 * lens.fovyRad) / lens.height;
}

class PicturePass {
 public:
  PicturePass(const Hierarchy& hierarchy, Renderer& renderer, const Session& session,
              const PictureOptions& options, std::filesystem::path folder, ImageResult& result)
      : hierarchy_(hierarchy),
        renderer_(renderer),
        session_(session),
        options_(options),
        folder_(std::move(folder)),
        result_(result) {}

  void drawFrame(int frame, const std::vector<StrategyFronts>& strategies) {
    const Camera camera = makeCamera(session_.lens, session_.poses[frame]);
    const std::vector<NodeId> leaves = listLeavesInside(hierarchy_, Frustum(camera));
    // the picture to compare with has both faces, so that what culling loses shows
    const FaceCulling culling = renderer_.setFaceCulling(FaceCulling::kNone);
    const View full = drawView(camera, [&] { renderer_.drawNodes(leaves); });
    renderer_.setFaceCulling(culling);
    const DepthImage depth = renderer_.readDepth();
    const FullPicture& entry = result_.full.emplace_back(FullPicture{
        frame, write(kFullModel, frame, "", full.color), countCoveredPixels(full.objects)});
    std::vector<const Front*> fronts;
    for (const StrategyFronts& strategy : strategies) fronts.push_back(find(strategy, frame));
    std::optional<View> reference;
    for (std::size_t i = 0; i < strategies.size(); ++i)
      if (strategies[i].strategy == result_.reference && fronts[i] != nullptr)
        reference = drawView(camera, [&] { drawFront(*fronts[i]); });
    for (std::size_t i = 0; i < strategies.size(); ++i) {
      if (fronts[i] == nullptr) continue;
      const bool isReference = strategies[i].strategy == result_.reference;
      const View view = isReference ? *reference : drawView(camera, [&] { drawFront(*fronts[i]); });
      PictureFrame picture;
      picture.frame = frame;
      picture.file = write(strategies[i].strategy, frame, "", view.color);
      picture.rarnNodes =
          static_cast<int>(std::count_if(fronts[i]->nodes.begin(), fronts[i]->nodes.end(),
                                         [](const DrawnNode& drawn) { return drawn.refined; }));
      if (reference && !isReference)
        picture.vsReference = computePsnr(view.color, reference->color);
      picture.vsFull = computePsnr(view.color, full.color);
      picture.coveredPixels = entry.coveredPixels;
      picture.wrongPixels = countWrongPixels(view.objects, full.objects);
      picture.crackPixels =
          countCrackPixels(view.color, depth, computePixelSize(camera.lens), result_.crackMargin);
      for (const std::string& overlay : options_.overlays)
        picture.overlays[overlay] = write(strategies[i].strategy, frame, "." + overlay,
                                          drawOverlay(camera, overlay, *fronts[i]));
      result_.strategies[i].frames.push_back(std::move(picture));
    }
  }

 private:
  static const Front* find(const StrategyFronts& strategy, int frame) {
    const auto found = std::find_if(strategy.fronts.begin(), strategy.fronts.end(),
                                    [&](const Front& front) { return front.frame == frame; });
    return found == strategy.fronts.end() ? nullptr : &*found;
  }

  template <typename Draw>
  View drawView(const Camera& camera, Draw draw) {
    View view;
    renderer_.beginFrame(camera);
    draw();
    view.color = renderer_.readColor();
    renderer_.beginFrame(camera, Shading::kObjects);
    draw();
    view.objects = renderer_.readColor();
    return view;
  }

  void drawFront(const Front& front) {
    std::vector<NodeId> nodes;
    for (const DrawnNode& drawn : front.nodes) nodes.push_back(drawn.node);
    renderer_.drawNodes(nodes);
  }

  Image drawOverlay(const Camera& camera, const std::string& name, const Front& front) {
    const std::vector<glm::vec3> tints = findOverlay(name).computeTints(hierarchy_, front);
    renderer_.beginFrame(camera, Shading::kTinted);
    for (std::size_t i = 0; i < front.nodes.size(); ++i) {
      renderer_.setTint(tints[i]);
      renderer_.drawNodes({&front.nodes[i].node, 1});
    }
    return renderer_.readColor();
  }

  std::string write(const std::string& name, int frame, const std::string& suffix,
                    const Image& image) {
    std::string file = fmt::format("{}.{:05}{}.{}", name, frame, suffix, options_.format);
    writePicture(folder_ / file, image);
    return file;
  }

  const Hierarchy& hierarchy_;
  Renderer& renderer_;
  const Session& session_;
  const PictureOptions& options_;
  std::filesystem::path folder_;
  ImageResult& result_;
};

}  // namespace

void drawPictures(const Hierarchy& hierarchy, Renderer& renderer, const Session& session,
                  const std::vector<StrategyFronts>& strategies, const PictureOptions& options,
                  const std::filesystem::path& folder, const std::function<bool()>& isInterrupted,
                  ImageResult& result) {
  result.format = options.format;
  result.overlays = options.overlays;
  result.width = session.lens.width;
  result.height = session.lens.height;
  for (const StrategyFronts& strategy : strategies) {
    if (strategy.strategy == kReference && !strategy.fronts.empty()) result.reference = kReference;
    result.strategies.push_back({strategy.strategy, strategy.label, {}});
  }
  ProgressLine line("pictures");
  PicturePass pass(hierarchy, renderer, session, options, folder, result);
  for (std::size_t i = 0; i < result.frames.size() && !isInterrupted(); ++i) {
    line.update(fmt::format("frame {}", result.frames[i]),
                static_cast<double>(i) / static_cast<double>(result.frames.size()));
    pass.drawFrame(result.frames[i], strategies);
  }
  result.complete = result.full.size() == result.frames.size();
}

}  // namespace hlodbench
