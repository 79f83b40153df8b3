#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "hlod/render/framebuffer.h"
#include "hlod/render/gl_program.h"
#include "hlod/render/residency.h"
#include "hlod/tree/hierarchy.h"
#include "hlod/view/camera.h"

namespace hlodbench {

// What becomes of the colours of nodes. Pictures of the same nodes in the same order cover the same
// pixels in each.
enum class Shading {
  kLit,       // the objects' colours, lit: what a user sees
  kObjects,   // the object's index in red (low byte) and green (high byte), whatever node draws it
  kTinted,    // the colour of setTint(), lit: overlays
  kFlat,      // the colour of setTint(), as it is: 8 bits a component arrive exactly
  kTriangles  // the triangle's number in its node, lowest byte in red, then green, blue
};

enum class FaceCulling {
  kNone,                // both faces are drawn
  kBackWhereConsistent  // only front faces, in nodes that have kConsistentWinding
};

// Of the boxes that queries count.
enum class QueryFaces {
  kFront,  // each covered pixel passes once
  kBoth    // front and back: a pixel passes up to twice
};

struct RendererOptions {
  std::uint64_t gpuMemory = kUnlimitedMemory;  // bytes for nodes' geometry, see Residency
  FaceCulling culling = FaceCulling::kNone;
  // Of one buffer of nodes' geometry. There are several where that is not enough, for drivers that
  // cannot address larger ones; see kMostPageBytes. Tests set it to have many.
  std::uint64_t mostPageBytes = kMostPageBytes;
  QueryFaces queryFaces = QueryFaces::kFront;
  bool clipsBoxes = true;  // at the near and far plane; false: their depth is clamped instead
};

// Draws nodes and boxes of a hierarchy. Knows nothing of why a node is drawn.
class Renderer {
 public:
  // Uploads the geometry, or as much of it as the options allow. The hierarchy must outlive the
  // renderer. Throws as Residency does.
  Renderer(const Hierarchy& hierarchy, int width, int height, const RendererOptions& options = {});

  // Clears the framebuffer, lets in nodes that have been read, and sets the camera, whose viewport
  // must be the framebuffer's size.
  void beginFrame(const Camera& camera, Shading shading = Shading::kLit);
  // Of the nodes drawn next; at first that of the options. Returns what it was.
  FaceCulling setFaceCulling(FaceCulling culling) {
    return std::exchange(options_.culling, culling);
  }
  // The colour of the nodes drawn next, linear RGB, 0 to 1; seen in Shading::kTinted and
  // kFlat only.
  void setTint(const glm::vec3& color);
  // Draws the node's LOD; where the GPU has no room for all nodes and it is not there yet, the
  // nearest ancestor that is there, once a frame.
  void drawNode(NodeId node);
  // Draws the LODs of nodes, in this order, with as few calls as their kinds allow: the picture
  // that drawNode() for each of them makes where all are there. Waits for those that are not.
  void drawNodes(std::span<const NodeId> nodes);
  // Draws the node's box, by default its front faces, tested against the depth buffer and leaving
  // no trace.
  void drawBox(NodeId node);

  // Of the current frame; where there is room for all nodes, nothing is ever missing.
  [[nodiscard]] bool isLimited() const { return residency_.isLimited(); }
  [[nodiscard]] const ResidencyCounters& residency() const { return residency_.counters(); }
  [[nodiscard]] Image readColor() const { return framebuffer_.readColor(); }
  // Of what was drawn since beginFrame().
  [[nodiscard]] DepthImage readDepth() const;
  // Puts what was drawn into another framebuffer, see Framebuffer::blit(), and leaves OpenGL's
  // state as somebody else expects it who draws there. beginFrame() comes next.
  void show(GLuint target, int x, int y, int width, int height);
  // Another size of the framebuffer, pixels, from the next beginFrame() on; results of queries that
  // are under way still count pixels of the old one. Throws std::runtime_error when the driver
  // refuses it.
  void resize(int width, int height);

 private:
  enum class State { kNone, kNodes, kBoxes };
  void setState(State state);
  void setCulling(bool on);
  // Binds the vertex array of a page; for the state kNodes.
  void setPage(std::uint32_t page);
  // What of a node decides how it is drawn; nodes that share it can be drawn by one call.
  struct Kind {
    bool isCulled;
    GLenum indexType;
    std::uint32_t page;
    bool operator==(const Kind&) const = default;
  };
  // These are of a node that is there.
  [[nodiscard]] Kind kindOf(NodeId id) const;
  [[nodiscard]] GLint firstVertex(NodeId id) const;
  [[nodiscard]] const void* indexPlace(NodeId id) const;
  // Makes ready for drawing nodes of this kind.
  void setKind(const Kind& kind);
  void drawThere(std::span<const NodeId> nodes);
  // A program and the places of its uniforms; -1 where it has none.
  struct Program {
    explicit Program(GlProgram linked);
    GlProgram program;
    GLint matrix, tint;
  };
  [[nodiscard]] const Program& nodeProgram() const {
    return nodePrograms_[static_cast<std::size_t>(shading_)];
  }
  void describeGeometry();
  void uploadColors();
  void uploadBoxes();

  const Hierarchy& hierarchy_;
  RendererOptions options_;
  Residency residency_;
  Framebuffer framebuffer_;
  std::array<Program, 5> nodePrograms_;  // by Shading
  Program boxProgram_;
  std::vector<GlVertexArray> nodeArrays_;  // by page
  GlVertexArray boxArray_;
  GlBuffer colors_, boxCorners_, boxIndices_;
  GlTexture colorTexture_;  // colors_ by object
  State state_ = State::kNone;
  bool isCulling_ = false;
  std::uint32_t page_ = 0;
  // of one call of drawNodes(), kept for their memory
  std::vector<GLsizei> counts_;
  std::vector<const void*> indexPlaces_;
  std::vector<GLint> firstVertices_;
  Lens lens_;  // of the frame
  Shading shading_ = Shading::kLit;
};

}  // namespace hlodbench
