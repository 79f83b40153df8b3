#pragma once

#include <hlodbench/frame_view.h>

#include <vector>

#include "hlod/tree/hierarchy.h"
#include "hlod/view/camera.h"
#include "hlod/view/frustum.h"
#include "traversals/options.h"

namespace hlodbench {

// Keeps what a FrameView shows: the nodes in the form of the public headers, close together, and
// what is remembered of them from frame to frame.
class SceneView final : private plugin::ViewGeometry {
 public:
  // The hierarchy must outlive this.
  SceneView(const Hierarchy& hierarchy, const TraversalOptions& options);
  SceneView(const SceneView&) = delete;
  SceneView& operator=(const SceneView&) = delete;

  // The next frame; the first is 0. The camera must live as long as the frame.
  void beginFrame(const Camera& camera);

  [[nodiscard]] const plugin::FrameView& frame() const { return view_; }
  [[nodiscard]] plugin::NodeState& state(NodeId node) { return states_[node]; }
  [[nodiscard]] const std::vector<plugin::NodeState>& states() const { return states_; }

  [[nodiscard]] double computeProjectedArea(NodeId node) const override;
  [[nodiscard]] bool isInsideFrustum(NodeId node) const override;
  [[nodiscard]] bool isCutByNearPlane(NodeId node) const override;

  // Pixels that the node's box covers in this frame, at least 1: the denominator of mu.
  [[nodiscard]] double computeBoxPixels(NodeId node) const;
  // Takes a query's result into the node's state: pixels and mu. boxPixels: those of its frame.
  void storePixels(NodeId node, std::uint32_t pixels, double boxPixels);

 private:
  const Hierarchy& hierarchy_;
  NearPlane nearPlane_;
  MuArea muArea_;
  std::vector<plugin::Node> nodes_;
  std::vector<plugin::NodeState> states_;
  plugin::FrameData data_;
  plugin::FrameView view_;
  const Camera* camera_ = nullptr;
  Frustum frustum_;
};

}  // namespace hlodbench
