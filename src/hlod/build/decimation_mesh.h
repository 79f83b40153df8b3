#pragma once

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

namespace hlodbench {

// OpenMesh's triangle mesh with two of its tests made inline. Distributions ship OpenMesh's library
// with its assertions on, and the decimater asks these millions of times; hiding them here makes it
// several times faster.
class DecimationMesh : public OpenMesh::TriMesh_ArrayKernelT<> {
 public:
  // The half-edge between two vertices, or an invalid handle.
  [[nodiscard]] HalfedgeHandle find_halfedge(VertexHandle from, VertexHandle to) const {
    const HalfedgeHandle first = halfedge_handle(from);
    HalfedgeHandle h = first;
    if (!h.is_valid()) return h;
    do {
      if (to_vertex_handle(h) == to) return h;
      h = nextAround(h);
    } while (h != first);
    return HalfedgeHandle();
  }

  // Whether collapsing `h` keeps the mesh manifold: the link condition (Dey et al. 1999) and the
  // cases of the border. Changes the vertices' tag bits.
  [[nodiscard]] bool is_collapse_ok(HalfedgeHandle h) {
    const HalfedgeHandle o = opposite_halfedge_handle(h);
    const VertexHandle from = to_vertex_handle(o);
    const VertexHandle to = to_vertex_handle(h);
    if (status(edge_handle(h)).deleted() || status(from).deleted() || status(to).deleted())
      return false;
    const VertexHandle left = apexOf(h);
    const VertexHandle right = apexOf(o);
    if (left == right || hangsByOneEdge(h) || hangsByOneEdge(o)) return false;
    tagNeighbours(from, false);
    tagNeighbours(to, true);
    if (!onlyTagged(from, left, right)) return false;
    // Two border vertices may only meet along the border.
    return !(is_boundary(from) && is_boundary(to) && !is_boundary(h) && !is_boundary(o));
  }

 private:
  [[nodiscard]] HalfedgeHandle nextAround(HalfedgeHandle h) const {
    return next_halfedge_handle(opposite_halfedge_handle(h));
  }

  // The third vertex of the half-edge's face; invalid on the border.
  [[nodiscard]] VertexHandle apexOf(HalfedgeHandle h) const {
    return is_boundary(h) ? VertexHandle() : to_vertex_handle(next_halfedge_handle(h));
  }

  // Whether the half-edge's face has no neighbour across its two other edges.
  [[nodiscard]] bool hangsByOneEdge(HalfedgeHandle h) const {
    if (is_boundary(h)) return false;
    const HalfedgeHandle next = next_halfedge_handle(h);
    return is_boundary(opposite_halfedge_handle(next)) &&
           is_boundary(opposite_halfedge_handle(next_halfedge_handle(next)));
  }

  void tagNeighbours(VertexHandle vertex, bool tag) {
    const HalfedgeHandle first = halfedge_handle(vertex);
    HalfedgeHandle h = first;
    do {
      status(to_vertex_handle(h)).set_tagged(tag);
      h = nextAround(h);
    } while (h != first);
  }

  // Whether none of the vertex's neighbours but these two carries the tag.
  [[nodiscard]] bool onlyTagged(VertexHandle vertex, VertexHandle left, VertexHandle right) const {
    const HalfedgeHandle first = halfedge_handle(vertex);
    HalfedgeHandle h = first;
    do {
      const VertexHandle neighbour = to_vertex_handle(h);
      if (status(neighbour).tagged() && neighbour != left && neighbour != right) return false;
      h = nextAround(h);
    } while (h != first);
    return true;
  }
};

}  // namespace hlodbench
