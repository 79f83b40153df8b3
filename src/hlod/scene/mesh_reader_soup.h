#pragma once

// Where OpenMesh's readers put what they read; nobody but the mesh reader includes this.

#include <OpenMesh/Core/IO/importer/BaseImporter.hh>
#include <string>
#include <utility>
#include <vector>

#include "hlod/scene/mesh_reader_faults.h"
#include "hlod/scene/mesh_reader_parts.h"

namespace hlodbench::mesh_reader {

// Collects vertices and faces as they come. OpenMesh's own importers build a half-edge mesh and
// drop each face that would make it non-manifold; this one keeps all and only checks indices.
class SoupImporter final : public OpenMesh::IO::BaseImporter {
 public:
  // Faces may name vertices 0 to vertices - 1; errors begin with the file's name.
  SoupImporter(std::string fileName, std::uint64_t vertices)
      : file_{std::move(fileName), {}}, vertices_(vertices) {}

  [[nodiscard]] std::size_t pointsSet() const { return pointsSet_; }
  [[nodiscard]] MeshFile takeMesh() { return std::move(mesh_); }

  OpenMesh::VertexHandle add_vertex(const OpenMesh::Vec3f& point) override {
    const OpenMesh::VertexHandle handle = add_vertex();
    set_point(handle, point);
    return handle;
  }
  OpenMesh::VertexHandle add_vertex() override {
    mesh_.positions.emplace_back(0.0f);
    return OpenMesh::VertexHandle(static_cast<int>(mesh_.positions.size() - 1));
  }
  void set_point(OpenMesh::VertexHandle vertex, const OpenMesh::Vec3f& point) override {
    mesh_.positions[static_cast<std::size_t>(vertex.idx())] = {point[0], point[1], point[2]};
    ++pointsSet_;
  }
  OpenMesh::FaceHandle add_face(const VHandles& corners) override {
    if (corners.size() < 3) failOnCorners(file_, faces_, corners.size());
    corners_.clear();
    for (const OpenMesh::VertexHandle corner : corners) {
      // An index of 2^31 or more arrives as a negative one, which is too large without its sign.
      if (static_cast<std::uint64_t>(corner.idx()) >= vertices_)
        failOnIndex(file_, faces_, vertices_, corner.idx());
      corners_.push_back(static_cast<std::uint32_t>(corner.idx()));
    }
    addPolygon(corners_, mesh_);
    return OpenMesh::FaceHandle(static_cast<int>(faces_++));
  }
  [[nodiscard]] std::size_t n_vertices() const override { return mesh_.positions.size(); }
  [[nodiscard]] std::size_t n_faces() const override { return faces_; }
  [[nodiscard]] std::size_t n_edges() const override { return 0; }
  // The header has been checked against the file's size by now, so its counts are safe to use.
  void reserve(unsigned vertices, unsigned, unsigned faces) override {
    mesh_.positions.reserve(vertices);
    mesh_.triangles.reserve(faces);
  }

  // The rest of the interface: connectivity and attributes, which a soup has none of.
  using Half = OpenMesh::HalfedgeHandle;
  using Edge = OpenMesh::EdgeHandle;
  using Face = OpenMesh::FaceHandle;
  using Vertex = OpenMesh::VertexHandle;
  using Status = OpenMesh::Attributes::StatusInfo;
  using Vec2f = OpenMesh::Vec2f;
  using Vec3f = OpenMesh::Vec3f;
  using Vec4f = OpenMesh::Vec4f;
  using Vec3d = OpenMesh::Vec3d;
  using Vec3uc = OpenMesh::Vec3uc;
  using Vec4uc = OpenMesh::Vec4uc;
  Half add_edge(Vertex, Vertex) override { return Half(); }
  Face add_face(Half) override { return Face(); }
  void add_face_texcoords(Face, Vertex, const std::vector<Vec2f>&) override {}
  void add_face_texcoords(Face, Vertex, const std::vector<Vec3f>&) override {}
  void add_texture_information(int, std::string) override {}
  void request_face_texcoords2D() override {}
  void set_face_texindex(Face, int) override {}
  void set_halfedge(Vertex, Half) override {}
  void set_next(Half, Half) override {}
  void set_face(Half, Face) override {}
  void set_normal(Vertex, const Vec3f&) override {}
  void set_normal(Vertex, const Vec3d&) override {}
  void set_normal(Face, const Vec3f&) override {}
  void set_normal(Face, const Vec3d&) override {}
  void set_color(Vertex, const Vec3uc&) override {}
  void set_color(Vertex, const Vec4uc&) override {}
  void set_color(Vertex, const Vec3f&) override {}
  void set_color(Vertex, const Vec4f&) override {}
  void set_color(Edge, const Vec3uc&) override {}
  void set_color(Edge, const Vec4uc&) override {}
  void set_color(Edge, const Vec3f&) override {}
  void set_color(Edge, const Vec4f&) override {}
  void set_color(Face, const Vec3uc&) override {}
  void set_color(Face, const Vec4uc&) override {}
  void set_color(Face, const Vec3f&) override {}
  void set_color(Face, const Vec4f&) override {}
  void set_texcoord(Vertex, const Vec2f&) override {}
  void set_texcoord(Vertex, const Vec3f&) override {}
  void set_texcoord(Half, const Vec2f&) override {}
  void set_texcoord(Half, const Vec3f&) override {}
  void set_status(Vertex, const Status&) override {}
  void set_status(Half, const Status&) override {}
  void set_status(Edge, const Status&) override {}
  void set_status(Face, const Status&) override {}

 private:
  FileText file_;  // its name only
  std::uint64_t vertices_;
  std::size_t pointsSet_ = 0;
  std::size_t faces_ = 0;
  MeshFile mesh_;
  std::vector<std::uint32_t> corners_;  // of one face; a member to be allocated once
};

}  // namespace hlodbench::mesh_reader
