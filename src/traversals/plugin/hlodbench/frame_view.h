#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "bias.h"

namespace hlodbench::plugin {

using NodeId = std::uint32_t;
inline constexpr NodeId kNoNode = 0xffffffffu;
inline constexpr NodeId kRoot = 0;

// One node of the HLOD hierarchy. Boxes nest and errors do not decrease towards the root.
struct Node {
  float boxMin[3], boxMax[3];  // world units; the box holds every triangle of the subtree
  float error;                 // world units; 0 in a leaf
  std::uint32_t level;         // 0 for the root
  NodeId parent;               // kNoNode for the root
  NodeId firstChild;           // children are neighbours: firstChild .. firstChild + childCount - 1
  std::uint32_t childCount;    // 0 to 8; 0 makes a leaf
  std::uint32_t triangleCount;

  [[nodiscard]] bool isLeaf() const { return childCount == 0; }
};

// What is remembered of a node from frame to frame (paper, Figs. 2 and 3). The program keeps it.
struct NodeState {
  double bias = 1.0;              // B(mu) of the last result, 0 to 1
  double mu = 1.0;                // relative visibility in the last result, 0 to 1
  std::uint32_t pixels = 0;       // that passed in the last result; a box cut by the near plane has
                                  // no query: mu and bias are 1 then, and this stays
  std::int32_t lastVisited = -1;  // frame in which the node was last taken up inside the frustum
  std::int32_t lastRendered = -1;  // frame in which it was last drawn
  bool visible = false;            // some pixel of it, or below it, was seen in frame lastVisited
  bool stopRefinement = false;     // the front ended here in frame lastVisited
  bool delayed = false;            // its draw waited for the result in frame lastVisited
};

// One frame's view.
struct Camera {
  double eye[3], forward[3], up[3];            // world units; the directions have length 1
  double fovy;                                 // vertical field of view, radians
  double nearPlane, farPlane;                  // world units
  double viewProjection[16];                   // OpenGL clip space, column by column
  double pixelScale;                           // pixels that a world unit covers at distance 1
  std::int32_t viewportWidth, viewportHeight;  // pixels
};

// What a FrameView has the program compute.
class ViewGeometry {
 public:
  [[nodiscard]] virtual double computeProjectedArea(NodeId node) const = 0;
  [[nodiscard]] virtual bool isInsideFrustum(NodeId node) const = 0;
  [[nodiscard]] virtual bool isCutByNearPlane(NodeId node) const = 0;

 protected:
  ~ViewGeometry() = default;
};

// What a FrameView is made of; the program fills it. What comes later is added at the end.
struct FrameData {
  const Node* nodes = nullptr;
  const NodeState* states = nullptr;
  std::uint32_t nodeCount = 0;
  std::int32_t frame = -1;
  double tau = 1.0;
  BiasOptions bias;
  Camera camera = {};
  const ViewGeometry* geometry = nullptr;
};

// What may be known while a frame is rendered: the hierarchy, what is remembered of its nodes, the
// options that all strategies share, the camera. Whatever takes a node throws std::out_of_range,
// "asked for node 7; the hierarchy has 5 nodes", for one that there is not.
class FrameView {
 public:
  FrameView() = default;
  explicit FrameView(const FrameData& data) : data_(data) {}

  [[nodiscard]] std::uint32_t nodeCount() const { return data_.nodeCount; }
  [[nodiscard]] const Node& node(NodeId id) const { return data_.nodes[check(id)]; }
  // A predictor that is asked about a node sees the last frame's state of it.
  [[nodiscard]] const NodeState& state(NodeId id) const { return data_.states[check(id)]; }

  // From 0 on; a strategy meets each frame once.
  [[nodiscard]] std::int32_t frame() const { return data_.frame; }
  // Pixels of error: a node is refined while its error is above it (--tau).
  [[nodiscard]] double tau() const { return data_.tau; }
  [[nodiscard]] const Camera& camera() const { return data_.camera; }

  // B(mu), 0 to 1, with the run's s, t and exponent.
  [[nodiscard]] double computeBias(double mu) const { return plugin::computeBias(mu, data_.bias); }
  [[nodiscard]] const BiasOptions& biasOptions() const { return data_.bias; }

  // Whether the node was taken up in the last frame, and seen.
  [[nodiscard]] bool wasVisible(NodeId id) const {
    const NodeState& s = state(id);
    return s.lastVisited == data_.frame - 1 && s.visible;
  }

  // Distance of the eye to the nearest point of the node's box, world units; 0 inside it.
  [[nodiscard]] double computeDistance(NodeId id) const {
    const Node& n = node(id);
    double squares = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double eye = data_.camera.eye[axis];
      const double outside = std::max(static_cast<double>(n.boxMin[axis]) - eye,
                                      eye - static_cast<double>(n.boxMax[axis]));
      const double d = std::max(outside, 0.0);
      squares += d * d;
    }
    return std::sqrt(squares);
  }
  // Screen-space error (SSE), pixels, at the nearest point of the node's box; paper, section 3.1.
  // A child's is never larger than its parent's.
  [[nodiscard]] double computeSse(NodeId id) const {
    const double distance = std::max(data_.camera.nearPlane, computeDistance(id));
    return data_.nodes[id].error * data_.camera.pixelScale / distance;
  }
  // Pixels of the viewport that the node's box covers: the denominator of mu. Not for a box that
  // the near plane cuts. Costs some hundred nanoseconds, as the next two some ten.
  [[nodiscard]] double computeProjectedArea(NodeId id) const {
    return data_.geometry->computeProjectedArea(check(id));
  }
  // False only if the node's box lies wholly behind one of the frustum's planes.
  [[nodiscard]] bool isInsideFrustum(NodeId id) const {
    return data_.geometry->isInsideFrustum(check(id));
  }
  // True if a corner of the box is no farther along the view direction than the near plane: no
  // query can count its pixels, and it is taken as wholly visible.
  [[nodiscard]] bool isCutByNearPlane(NodeId id) const {
    return data_.geometry->isCutByNearPlane(check(id));
  }

 private:
  [[nodiscard]] NodeId check(NodeId id) const {
    if (id >= data_.nodeCount) fail(id);
    return id;
  }
  [[noreturn]] void fail(NodeId id) const {
    throw std::out_of_range("asked for node " + std::to_string(id) + "; the hierarchy has " +
                            std::to_string(data_.nodeCount) + " nodes");
  }

  FrameData data_;
};

}  // namespace hlodbench::plugin
