#include "hlod/build/openmesh_simplifier.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>

#include "hlod/build/quadric_module.h"

namespace hlodbench {
namespace {

using Mesh = OpenMesh::TriMesh_ArrayKernelT<>;
using VertexHandle = Mesh::VertexHandle;
using FaceHandle = Mesh::FaceHandle;

// Turns a triangle list into half-edges, which cannot hold every list: a face that does not fit is
// turned over; if it still does not fit it goes to the next layer, which has copies of its vertices
// and so starts as an empty mesh.
class LayeredMesh {
 public:
  LayeredMesh(const SimplifierInput& input, SimplifierStats& stats) : input_(input), stats_(stats) {
    mesh_.request_vertex_status();
    mesh_.request_edge_status();
    mesh_.request_face_status();
    std::vector<glm::uvec3> triangles = removeUselessTriangles(input.triangles, stats);
    mesh_.reserve(input.positions.size() + 16, triangles.size() * 3 / 2 + 256,
                  triangles.size() + 16);
    std::uint64_t vertices = 0;
    while (!triangles.empty()) {
      addLayer(triangles);
      if (vertices != 0) stats_.splitVertices += mesh_.n_vertices() - vertices;
      vertices = mesh_.n_vertices();
    }
  }

  [[nodiscard]] Mesh& mesh() { return mesh_; }

  // What is left, as triangles over the input's vertices, each with the winding it came with.
  [[nodiscard]] std::vector<glm::uvec3> triangles() const {
    std::vector<glm::uvec3> out;
    for (const FaceHandle face : mesh_.faces()) {
      const auto h = mesh_.halfedge_handle(face);
      const auto next = mesh_.next_halfedge_handle(h);
      glm::uvec3 t(source_[index(mesh_.from_vertex_handle(h))],
                   source_[index(mesh_.to_vertex_handle(h))],
                   source_[index(mesh_.to_vertex_handle(next))]);
      if (t.x == t.y || t.y == t.z || t.z == t.x) continue;
      if (flipped_[static_cast<std::size_t>(face.idx())] != 0) std::swap(t.y, t.z);
      out.push_back(t);
    }
    return out;
  }

 private:
  static std::size_t index(VertexHandle v) { return static_cast<std::size_t>(v.idx()); }

  // Adds what fits in one layer; leaves the rest in `triangles`. A layer takes its first face in
  // any case, so this ends.
  void addLayer(std::vector<glm::uvec3>& triangles) {
    copies_.assign(input_.positions.size(), VertexHandle());
    std::vector<glm::uvec3> refused;
    for (const glm::uvec3& t : triangles) {
      const VertexHandle a = copyOf(t.x);
      const VertexHandle b = copyOf(t.y);
      const VertexHandle c = copyOf(t.z);
      if (addFace(a, b, c)) {
        flipped_.push_back(0);
      } else if (addFace(a, c, b)) {
        flipped_.push_back(1);
        ++stats_.flippedFaces;
      } else {
        refused.push_back(t);
      }
    }
    triangles = std::move(refused);
  }

  VertexHandle copyOf(std::uint32_t vertex) {
    VertexHandle& copy = copies_[vertex];
    if (copy.is_valid()) return copy;
    const glm::vec3& p = input_.positions[vertex];
    copy = mesh_.add_vertex(Mesh::Point(p.x, p.y, p.z));
    mesh_.status(copy).set_locked(input_.locked[vertex] != 0);
    source_.push_back(vertex);
    return copy;
  }

  // Asks first what add_face() would refuse, because it also prints a message when it does.
  bool addFace(VertexHandle a, VertexHandle b, VertexHandle c) {
    if (!mesh_.is_boundary(a) || !mesh_.is_boundary(b) || !mesh_.is_boundary(c)) return false;
    if (!isEdgeFree(a, b) || !isEdgeFree(b, c) || !isEdgeFree(c, a)) return false;
    return mesh_.add_face(a, b, c).is_valid();
  }

  bool isEdgeFree(VertexHandle from, VertexHandle to) {
    const auto h = mesh_.find_halfedge(from, to);
    return !h.is_valid() || mesh_.is_boundary(h);
  }

  const SimplifierInput& input_;
  SimplifierStats& stats_;
  Mesh mesh_;
  std::vector<VertexHandle> copies_;   // of the input's vertices, in the current layer
  std::vector<std::uint32_t> source_;  // one a mesh vertex: the input's vertex
  std::vector<std::uint8_t> flipped_;  // one a mesh face
};

class OpenMeshSimplifier final : public Simplifier {
 public:
  [[nodiscard]] std::vector<glm::uvec3> simplify(const SimplifierInput& input,
                                                 SimplifierStats& stats) const override {
    LayeredMesh layered(input, stats);
    if (layered.mesh().n_faces() > input.targetTriangles) {
      using Module = QuadricModule<Mesh>;
      OpenMesh::Decimater::DecimaterT<Mesh> decimater(layered.mesh());
      Module::Handle module;
      decimater.add(module);
      decimater.initialize();
      decimater.decimate_to_faces(0, input.targetTriangles);
      return layered.triangles();
    }
    return layered.triangles();
  }
};

}  // namespace

std::unique_ptr<Simplifier> createOpenMeshSimplifier() {
  return std::make_unique<OpenMeshSimplifier>();
}

}  // namespace hlodbench
