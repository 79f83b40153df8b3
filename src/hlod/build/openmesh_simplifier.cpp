#include "hlod/build/openmesh_simplifier.h"

#include <OpenMesh/Core/System/omstream.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>

#include <iterator>

#include "hlod/build/decimation_mesh.h"
#include "hlod/build/free_collapse.h"
#include "hlod/build/manifold_parts.h"
#include "hlod/build/quadric_module.h"

namespace hlodbench {
namespace {

using VertexHandle = DecimationMesh::VertexHandle;
using FaceHandle = DecimationMesh::FaceHandle;

// The half-edge mesh of a triangle list, which may be anything: it is taken apart into manifold
// parts first. A face that does not fit even so (two parts that meet along the same edge of the
// same two vertices) goes to the next layer, which has copies of its vertices and starts empty.
class LayeredMesh {
 public:
  LayeredMesh(const SimplifierInput& input, SimplifierStats& stats) : input_(input), stats_(stats) {
    mesh_.request_vertex_status();
    mesh_.request_edge_status();
    mesh_.request_face_status();
    parts_ = computeManifoldParts(removeUselessTriangles(input, stats));
    mesh_.reserve(parts_.source.size() + 16, parts_.triangles.size() * 3 / 2 + 256,
                  parts_.triangles.size() + 16);
    std::vector<std::uint32_t> faces(parts_.triangles.size());
    for (std::uint32_t face = 0; face < faces.size(); ++face) faces[face] = face;
    while (!faces.empty()) addLayer(faces);
    countStats();
  }

  [[nodiscard]] DecimationMesh& mesh() { return mesh_; }

  // The mesh counts removed faces as there; this is their number.
  [[nodiscard]] std::size_t removedFaces() const {
    return mesh_.n_faces() -
           static_cast<std::size_t>(std::distance(mesh_.faces_sbegin(), mesh_.faces_end()));
  }

  // The share of the free vertices that cannot be removed because of the mesh's topology.
  [[nodiscard]] double stuckShare() {
    std::size_t free = 0;
    std::size_t stuck = 0;
    for (const VertexHandle v : mesh_.vertices()) {
      if (mesh_.status(v).locked() || mesh_.is_isolated(v)) continue;
      ++free;
      bool canGo = false;
      for (const auto h : mesh_.voh_range(v)) canGo = canGo || mesh_.is_collapse_ok(h);
      stuck += canGo ? 0 : 1;
    }
    return free == 0 ? 0.0 : static_cast<double>(stuck) / static_cast<double>(free);
  }

  // What is left, as triangles over the input's vertices, each with the winding it came with.
  [[nodiscard]] std::vector<glm::uvec3> triangles() const {
    std::vector<glm::uvec3> out;
    for (const FaceHandle face : mesh_.faces()) {
      const auto h = mesh_.halfedge_handle(face);
      const auto next = mesh_.next_halfedge_handle(h);
      glm::uvec3 t(source_[index(mesh_.from_vertex_handle(h))],
                   source_[index(mesh_.to_vertex_handle(h))],
                   source_[index(mesh_.to_vertex_handle(next))]);
      // Two copies of one vertex may have become neighbours.
      if (t.x == t.y || t.y == t.z || t.z == t.x) continue;
      if (flipped_[static_cast<std::size_t>(face.idx())] != 0) std::swap(t.y, t.z);
      out.push_back(t);
    }
    return out;
  }

 private:
  static std::size_t index(VertexHandle v) { return static_cast<std::size_t>(v.idx()); }

  // Adds what fits in one layer and leaves the rest in `faces`. A layer takes its first face in any
  // case, so this ends.
  void addLayer(std::vector<std::uint32_t>& faces) {
    copies_.assign(parts_.source.size(), VertexHandle());
    std::vector<std::uint32_t> refused;
    for (const std::uint32_t face : faces) {
      const glm::uvec3& t = parts_.triangles[face];
      if (addFace(copyOf(t.x), copyOf(t.y), copyOf(t.z)))
        flipped_.push_back(parts_.flipped[face]);
      else
        refused.push_back(face);
    }
    faces = std::move(refused);
  }

  VertexHandle copyOf(std::uint32_t vertex) {
    VertexHandle& copy = copies_[vertex];
    if (copy.is_valid()) return copy;
    const std::uint32_t source = parts_.source[vertex];
    const glm::vec3& p = input_.positions[source];
    copy = mesh_.add_vertex(DecimationMesh::Point(p.x, p.y, p.z));
    mesh_.status(copy).set_locked(input_.locked[source] != 0);
    source_.push_back(source);
    return copy;
  }

  bool addFace(VertexHandle a, VertexHandle b, VertexHandle c) {
    if (!mesh_.is_boundary(a) || !mesh_.is_boundary(b) || !mesh_.is_boundary(c)) return false;
    if (!isEdgeFree(a, b) || !isEdgeFree(b, c) || !isEdgeFree(c, a)) return false;
    return mesh_.add_face(a, b, c).is_valid();
  }

  bool isEdgeFree(VertexHandle from, VertexHandle to) {
    const auto h = mesh_.find_halfedge(from, to);
    return !h.is_valid() || mesh_.is_boundary(h);
  }

  void countStats() {
    std::vector<std::uint8_t> seen(input_.positions.size(), 0);
    for (const std::uint32_t source : source_) {
      if (seen[source] != 0 && input_.locked[source] == 0) ++stats_.splitVertices;
      seen[source] = 1;
    }
    for (const std::uint8_t flipped : flipped_) stats_.flippedFaces += flipped;
  }

  const SimplifierInput& input_;
  SimplifierStats& stats_;
  ManifoldParts parts_;
  DecimationMesh mesh_;
  std::vector<VertexHandle> copies_;   // of the parts' vertices, in the current layer
  std::vector<std::uint32_t> source_;  // one a mesh vertex: the input's vertex
  std::vector<std::uint8_t> flipped_;  // one a mesh face
};

// Over this share of stuck vertices, topology is in the way.
constexpr double kMuchStuck = 0.01;

class OpenMeshSimplifier final : public Simplifier {
 public:
  // OpenMesh prints each face that it refuses; those are dealt with here.
  OpenMeshSimplifier() { omerr().disable(); }

  [[nodiscard]] std::vector<glm::uvec3> simplify(const SimplifierInput& input,
                                                 SimplifierStats& stats) const override {
    LayeredMesh layered(input, stats);
    if (layered.mesh().n_faces() <= input.targetTriangles) return layered.triangles();
    using Module = QuadricModule<DecimationMesh>;
    OpenMesh::Decimater::DecimaterT<DecimationMesh> decimater(layered.mesh());
    Module::Handle module;
    decimater.add(module);
    decimater.initialize();
    // Half way there, see whether topology stands in the way: handles and small bodies cannot go,
    // so towards the end they would take the budget from everything else.
    decimater.decimate_to_faces(0, 2 * input.targetTriangles);
    if (layered.stuckShare() < kMuchStuck)
      decimater.decimate_to_faces(0, input.targetTriangles + layered.removedFaces());
    std::vector<glm::uvec3> triangles = layered.triangles();
    if (triangles.size() <= input.targetTriangles) return triangles;
    return collapseFreely(input, std::move(triangles), stats);
  }
};

}  // namespace

std::unique_ptr<Simplifier> createOpenMeshSimplifier() {
  return std::make_unique<OpenMeshSimplifier>();
}

}  // namespace hlodbench
