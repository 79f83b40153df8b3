#pragma once

#include "hlod/render/framebuffer.h"
#include "hlod/render/gl_program.h"
#include "hlod/tree/hierarchy.h"
#include "hlod/view/camera.h"

namespace hlodbench {

// Draws nodes and boxes of a hierarchy whose geometry is resident in one vertex and one index
// buffer. Knows nothing of why a node is drawn.
class Renderer {
 public:
  // Uploads the geometry. The hierarchy must outlive the renderer; its vertices and indices are
  // not read again. Throws std::runtime_error when the driver has no memory for it.
  Renderer(const Hierarchy& hierarchy, int width, int height);

  // Clears the framebuffer and sets the camera, whose viewport must be the framebuffer's size.
  void beginFrame(const Camera& camera);
  // Draws the node's LOD, both faces, lit.
  void drawNode(NodeId node);
  // Draws the front faces of the node's box, tested against the depth buffer and leaving no trace.
  void drawBox(NodeId node);

  [[nodiscard]] Image readColor() const { return framebuffer_.readColor(); }

 private:
  enum class State { kNone, kNodes, kBoxes };
  void setState(State state);
  void uploadGeometry();
  void uploadBoxes();

  const Hierarchy& hierarchy_;
  Framebuffer framebuffer_;
  GlProgram nodeProgram_, boxProgram_;
  GlVertexArray nodeArray_, boxArray_;
  GlBuffer vertices_, indices_, boxCorners_, boxIndices_;
  GLint nodeMatrix_, boxMatrix_;
  State state_ = State::kNone;
};

}  // namespace hlodbench
