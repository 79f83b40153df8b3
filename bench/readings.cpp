#include "readings.h"

#include "choice.h"

namespace hlodbench {
namespace {

template <typename T>
using Names = std::vector<std::pair<std::string, T>>;

const Names<PullUp> kPullUp{{"refine", PullUp::kRefine}, {"delay", PullUp::kDelay}};
const Names<RenderGuard> kRenderGuard{{"on", RenderGuard::kOn}, {"off", RenderGuard::kOff}};
const Names<NearPlane> kNearPlane{{"visible", NearPlane::kVisible}, {"query", NearPlane::kQuery}};
const Names<MuArea> kMuArea{{"clipped", MuArea::kClipped}, {"unclipped", MuArea::kUnclipped}};
const Names<QueryFaces> kQueryFaces{{"front", QueryFaces::kFront}, {"both", QueryFaces::kBoth}};

template <typename T>
std::string nameOf(const Names<T>& names, T value) {
  for (const auto& [name, named] : names)
    if (named == value) return name;
  return "";
}

}  // namespace

void addReadingOptions(CLI::App& sub, TraversalOptions& traversal, QueryFaces& faces) {
  addChoice<PullUp>(sub, "--pull-up", traversal.pullUp, kPullUp,
                    "Coh(B), Fig. 3: with a child that goes on, refine its parent, or delay it");
  addChoice<RenderGuard>(sub, "--render-guard", traversal.renderGuard, kRenderGuard,
                         "draw a node once a frame; off: again when its result confirms a Stop, "
                         "Fig. 2 literally");
  addChoice<NearPlane>(sub, "--near-plane", traversal.nearPlane, kNearPlane,
                       "boxes that the near plane cuts: visible without a query, or queried while "
                       "the eye is outside of them");
  addChoice<QueryFaces>(sub, "--query-faces", faces, kQueryFaces,
                        "faces of the boxes that are queried; both: a pixel may pass twice");
  addChoice<MuArea>(sub, "--mu-area", traversal.muArea, kMuArea,
                    "pixels of a box that mu is a share of: those in the viewport, or all");
}

std::vector<std::pair<std::string, std::string>> listReadings(const TraversalOptions& traversal,
                                                              QueryFaces faces) {
  return {{"pull_up", nameOf(kPullUp, traversal.pullUp)},
          {"render_guard", nameOf(kRenderGuard, traversal.renderGuard)},
          {"near_plane", nameOf(kNearPlane, traversal.nearPlane)},
          {"query_faces", nameOf(kQueryFaces, faces)},
          {"mu_area", nameOf(kMuArea, traversal.muArea)}};
}

}  // namespace hlodbench
