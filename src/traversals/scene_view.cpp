#include "traversals/scene_view.h"

#include <algorithm>

#include "hlod/view/projected_area.h"
#include "hlod/view/screen_error.h"

namespace hlodbench {
namespace {

plugin::Node toPublic(const Node& node) {
  const Aabb& b = node.box;
  return {{b.min.x, b.min.y, b.min.z},
          {b.max.x, b.max.y, b.max.z},
          node.error,
          node.level,
          node.parent,
          node.firstChild,
          node.childCount,
          node.triangleCount()};
}

template <typename Vector>
void store(const Vector& vector, double (&out)[3]) {
  for (int axis = 0; axis < 3; ++axis) out[axis] = vector[axis];
}

plugin::Camera toPublic(const Camera& camera) {
  plugin::Camera result{};
  store(camera.pose.position, result.eye);
  store(camera.forward(), result.forward);
  store(camera.pose.orientation * glm::dvec3(0.0, 1.0, 0.0), result.up);
  result.fovy = camera.lens.fovyRad;
  result.nearPlane = camera.lens.nearPlane;
  result.farPlane = camera.lens.farPlane;
  for (int i = 0; i < 16; ++i) result.viewProjection[i] = camera.viewProjection[i / 4][i % 4];
  result.pixelScale = computePixelScale(camera.lens);
  result.viewportWidth = camera.lens.width;
  result.viewportHeight = camera.lens.height;
  return result;
}

}  // namespace

SceneView::SceneView(const Hierarchy& hierarchy, const TraversalOptions& options)
    : hierarchy_(hierarchy),
      nearPlane_(options.nearPlane),
      muArea_(options.muArea),
      states_(hierarchy.nodes.size()),
      frustum_(Camera{}) {
  nodes_.reserve(hierarchy.nodes.size());
  for (const Node& node : hierarchy.nodes) nodes_.push_back(toPublic(node));
  data_.nodes = nodes_.data();
  data_.states = states_.data();
  data_.nodeCount = static_cast<std::uint32_t>(nodes_.size());
  data_.tau = options.tau;
  data_.bias = options.bias;
  data_.geometry = this;
}

void SceneView::beginFrame(const Camera& camera) {
  ++data_.frame;
  data_.camera = toPublic(camera);
  view_ = plugin::FrameView(data_);
  camera_ = &camera;
  frustum_ = Frustum(camera);
}

double SceneView::computeProjectedArea(NodeId node) const {
  const Aabb& box = hierarchy_.node(node).box;
  // a cut box has no bounds but those of the viewport
  if (nearPlane_ == NearPlane::kQuery && hlodbench::isCutByNearPlane(*camera_, box))
    return computeProjectedAreaOfCutBox(*camera_, box);
  return muArea_ == MuArea::kUnclipped ? computeUnclippedArea(*camera_, box)
                                       : hlodbench::computeProjectedArea(*camera_, box);
}

bool SceneView::isInsideFrustum(NodeId node) const {
  return frustum_.intersects(hierarchy_.node(node).box);
}

bool SceneView::isCutByNearPlane(NodeId node) const {
  const Aabb& box = hierarchy_.node(node).box;
  if (nearPlane_ == NearPlane::kQuery)
    return computeDistance(*camera_, box) <= 0.0;  // from inside, no front face is seen
  return hlodbench::isCutByNearPlane(*camera_, box);
}

double SceneView::computeBoxPixels(NodeId node) const {
  // the rasteriser and the analytic area may differ along the outline: a box under a pixel counts
  // as one, and mu is clamped
  return std::max(1.0, computeProjectedArea(node));
}

void SceneView::storePixels(NodeId node, std::uint32_t pixels, double boxPixels) {
  states_[node].pixels = pixels;
  states_[node].mu = std::min(1.0, pixels / boxPixels);
}

}  // namespace hlodbench
