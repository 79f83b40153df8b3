#pragma once

#include <OpenMesh/Core/Geometry/QuadricT.hh>
#include <OpenMesh/Core/Utils/Property.hh>
#include <OpenMesh/Tools/Decimater/ModBaseT.hh>

namespace hlodbench {

// Decimation module: the quadric error of a half-edge collapse (Garland and Heckbert 1997). It adds
// to OpenMesh's own quadric module what open surfaces need, planes that stand on border edges, so
// that a flat sheet does not shrink for free; and it refuses collapses that turn a face over.
template <class MeshT>
class QuadricModule : public OpenMesh::Decimater::ModBaseT<MeshT> {
 public:
  DECIMATING_MODULE(QuadricModule, MeshT, BorderQuadric)

  explicit QuadricModule(MeshT& mesh) : Base(mesh, false) { Base::mesh().add_property(quadrics_); }
  ~QuadricModule() override { Base::mesh().remove_property(quadrics_); }
  QuadricModule(const QuadricModule&) = delete;
  QuadricModule& operator=(const QuadricModule&) = delete;

  void initialize() override {
    MeshT& mesh = Base::mesh();
    for (auto vertex : mesh.vertices()) mesh.property(quadrics_, vertex).clear();
    for (auto face : mesh.faces()) addFace(face);
  }

  // The quadric error with area as weight, or ILLEGAL_COLLAPSE.
  float collapse_priority(const CollapseInfo& collapse) override {
    if (turnsFaceOver(collapse)) return static_cast<float>(Base::ILLEGAL_COLLAPSE);
    Quadric q = Base::mesh().property(quadrics_, collapse.v0);
    q += Base::mesh().property(quadrics_, collapse.v1);
    // On flat ground all collapses cost nothing; the shortest edge first gives better triangles.
    const double tieBreak = kShortEdgeFirst * (collapse.p1 - collapse.p0).sqrnorm();
    const double error = std::max(0.0, q(collapse.p1));
    return static_cast<float>(error + tieBreak);
  }

  void postprocess_collapse(const CollapseInfo& collapse) override {
    Base::mesh().property(quadrics_, collapse.v1) += Base::mesh().property(quadrics_, collapse.v0);
  }

 private:
  using Quadric = OpenMesh::Geometry::Quadricd;
  using Vector = OpenMesh::Vec3d;
  static constexpr double kBorderWeight = 10.0;  // of a border plane, times edge length squared
  static constexpr double kShortEdgeFirst =
      1e-12;                                 // in the node's frame, so a fixed number will do
  static constexpr double kMinCosine = 0.1;  // between a face's normals before and after

  [[nodiscard]] Vector point(typename MeshT::VertexHandle vertex) {
    return OpenMesh::vector_cast<Vector>(Base::mesh().point(vertex));
  }

  static Quadric planeQuadric(const Vector& normal, const Vector& onPlane, double weight) {
    Quadric q(normal[0], normal[1], normal[2], -(normal | onPlane));
    q *= weight;
    return q;
  }

  void addFace(typename MeshT::FaceHandle face) {
    MeshT& mesh = Base::mesh();
    const auto h0 = mesh.halfedge_handle(face);
    const auto h1 = mesh.next_halfedge_handle(h0);
    const auto h2 = mesh.next_halfedge_handle(h1);
    const Vector p0 = point(mesh.to_vertex_handle(h0));
    const Vector p1 = point(mesh.to_vertex_handle(h1));
    const Vector p2 = point(mesh.to_vertex_handle(h2));
    Vector normal = (p1 - p0) % (p2 - p0);
    const double doubleArea = normal.norm();
    if (!(doubleArea > 0.0)) return;
    normal /= doubleArea;
    const Quadric q = planeQuadric(normal, p0, 0.5 * doubleArea);
    for (const auto h : {h0, h1, h2}) {
      mesh.property(quadrics_, mesh.to_vertex_handle(h)) += q;
      if (mesh.is_boundary(mesh.opposite_halfedge_handle(h))) addBorder(h, normal);
    }
  }

  void addBorder(typename MeshT::HalfedgeHandle h, const Vector& faceNormal) {
    MeshT& mesh = Base::mesh();
    const auto from = mesh.from_vertex_handle(h);
    const auto to = mesh.to_vertex_handle(h);
    const Vector edge = point(to) - point(from);
    Vector normal = edge % faceNormal;
    const double length = normal.norm();
    if (!(length > 0.0)) return;
    normal /= length;
    const Quadric q = planeQuadric(normal, point(from), kBorderWeight * edge.sqrnorm());
    mesh.property(quadrics_, from) += q;
    mesh.property(quadrics_, to) += q;
  }

  [[nodiscard]] bool turnsFaceOver(const CollapseInfo& collapse) {
    MeshT& mesh = Base::mesh();
    for (auto h : mesh.voh_range(collapse.v0)) {
      const auto face = mesh.face_handle(h);
      if (!face.is_valid() || face == collapse.fl || face == collapse.fr) continue;
      const auto a = mesh.point(mesh.to_vertex_handle(h));
      const auto b = mesh.point(mesh.to_vertex_handle(mesh.next_halfedge_handle(h)));
      const auto before = (a - collapse.p0) % (b - collapse.p0);
      const auto after = (a - collapse.p1) % (b - collapse.p1);
      const double dot = before | after;
      const double lengths = double(before.sqrnorm()) * double(after.sqrnorm());
      // A face without area has no side, so anything may happen to it; but none may be made.
      if (before.sqrnorm() == 0.0f) continue;
      if (dot <= 0.0 || dot * dot < kMinCosine * kMinCosine * lengths) return true;
    }
    return false;
  }

  OpenMesh::VPropHandleT<Quadric> quadrics_;
};

}  // namespace hlodbench
