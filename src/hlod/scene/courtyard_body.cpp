#include "hlod/scene/courtyard_body.h"

#include <array>
#include <cmath>
#include <utility>

namespace hlodbench::courtyard {
namespace {

constexpr std::uint32_t kNone = ~0u;

// Writes the vertices and quads of one body.
class SurfaceWriter {
 public:
  SurfaceWriter(const Body& body, const Lattice& lattice, std::uint32_t object, TriangleMesh& mesh)
      : body_(body), lattice_(lattice), object_(object), mesh_(mesh) {}

  std::uint32_t addVertex(const glm::ivec3& vertex) {
    mesh_.positions.emplace_back(body_.place(lattice_, vertex));
    return static_cast<std::uint32_t>(mesh_.positions.size() - 1);
  }

  // The shorter diagonal makes the better pair of triangles; near ties keep the first one, so
  // that the last bit of a coordinate does not decide.
  void addQuad(const std::array<std::uint32_t, 4>& q) {
    const auto& p = mesh_.positions;
    const glm::vec3 first = p[q[2]] - p[q[0]];
    const glm::vec3 second = p[q[3]] - p[q[1]];
    if (glm::dot(second, second) < 0.99f * glm::dot(first, first)) {
      addTriangle(q[0], q[1], q[3]);
      addTriangle(q[1], q[2], q[3]);
    } else {
      addTriangle(q[0], q[1], q[2]);
      addTriangle(q[0], q[2], q[3]);
    }
  }

 private:
  void addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh_.triangles.emplace_back(a, b, c);
    mesh_.objects.push_back(object_);
  }

  const Body& body_;
  const Lattice& lattice_;
  std::uint32_t object_;
  TriangleMesh& mesh_;
};

bool isFilled(const Lattice& lattice, int x, int y) {
  if (x < 0 || y < 0 || x >= lattice.cells.x || y >= lattice.cells.y) return false;
  return lattice.removed.empty() ||
         !lattice.removed[static_cast<std::size_t>(y) * static_cast<std::size_t>(lattice.cells.x) +
                          static_cast<std::size_t>(x)];
}

// Calls visit(from, to) for each edge between a filled cell and an empty one, counter-clockwise
// around the filled cell as seen from +z.
template <typename Visit>
void visitBorder(const Lattice& lattice, Visit&& visit) {
  for (int y = 0; y < lattice.cells.y; ++y) {
    for (int x = 0; x < lattice.cells.x; ++x) {
      if (!isFilled(lattice, x, y)) continue;
      const glm::ivec2 a(x, y), b(x + 1, y), c(x + 1, y + 1), d(x, y + 1);
      if (!isFilled(lattice, x, y - 1)) visit(a, b);
      if (!isFilled(lattice, x + 1, y)) visit(b, c);
      if (!isFilled(lattice, x, y + 1)) visit(c, d);
      if (!isFilled(lattice, x - 1, y)) visit(d, a);
    }
  }
}

// Vertex numbers of the z layers of a solid; filled in as vertices are asked for.
class SolidLayers {
 public:
  SolidLayers(const Lattice& lattice, SurfaceWriter& writer)
      : stride_(lattice.cells.x + 1),
        writer_(writer),
        below_(static_cast<std::size_t>(stride_ * (lattice.cells.y + 1)), kNone),
        above_(below_) {}

  std::uint32_t below(int x, int y) { return get(below_, x, y, layer_); }
  std::uint32_t above(int x, int y) { return get(above_, x, y, layer_ + 1); }
  void advance() {
    std::swap(below_, above_);
    above_.assign(above_.size(), kNone);
    ++layer_;
  }

 private:
  std::uint32_t get(std::vector<std::uint32_t>& layer, int x, int y, int z) {
    std::uint32_t& index = layer[static_cast<std::size_t>(y * stride_ + x)];
    if (index == kNone) index = writer_.addVertex({x, y, z});
    return index;
  }

  int stride_;
  int layer_ = 0;
  SurfaceWriter& writer_;
  std::vector<std::uint32_t> below_, above_;
};

void appendSolid(const Lattice& lattice, SurfaceWriter& writer) {
  SolidLayers layers(lattice, writer);
  std::vector<std::pair<glm::ivec2, glm::ivec2>> border;
  visitBorder(lattice, [&](glm::ivec2 a, glm::ivec2 b) { border.emplace_back(a, b); });
  const auto addFace = [&](auto&& quad) {
    for (int y = 0; y < lattice.cells.y; ++y)
      for (int x = 0; x < lattice.cells.x; ++x)
        if (isFilled(lattice, x, y)) quad(x, y);
  };
  addFace([&](int x, int y) {
    writer.addQuad({layers.below(x, y), layers.below(x, y + 1), layers.below(x + 1, y + 1),
                    layers.below(x + 1, y)});
  });
  for (int z = 0; z < lattice.cells.z; ++z) {
    if (z > 0) layers.advance();
    for (const auto& [a, b] : border) {
      writer.addQuad({layers.below(a.x, a.y), layers.below(b.x, b.y), layers.above(b.x, b.y),
                      layers.above(a.x, a.y)});
    }
  }
  addFace([&](int x, int y) {
    writer.addQuad({layers.above(x, y), layers.above(x + 1, y), layers.above(x + 1, y + 1),
                    layers.above(x, y + 1)});
  });
}

void appendTorus(const Lattice& lattice, SurfaceWriter& writer, std::uint32_t first) {
  const int nx = lattice.cells.x, ny = lattice.cells.y;
  for (int y = 0; y < ny; ++y)
    for (int x = 0; x < nx; ++x) writer.addVertex({x, y, 0});
  const auto index = [&](int x, int y) {
    return first + static_cast<std::uint32_t>((y % ny) * nx + x % nx);
  };
  for (int y = 0; y < ny; ++y)
    for (int x = 0; x < nx; ++x)
      writer.addQuad({index(x, y), index(x + 1, y), index(x + 1, y + 1), index(x, y + 1)});
}

}  // namespace

glm::dvec3 Placement::apply(const glm::dvec3& point) const {
  const double c = std::cos(yaw), s = std::sin(yaw);
  const glm::dvec3 turned(c * point.x + s * point.z, point.y, c * point.z - s * point.x);
  return origin + scale * turned;
}

Body movedBody(Body body, const Placement& placement) {
  return {[inner = body.lattice, scale = placement.scale](double density) {
            return inner(density * scale);
          },
          [inner = body.place, placement](const Lattice& lattice, const glm::ivec3& vertex) {
            return placement.apply(inner(lattice, vertex));
          }};
}

ObjectPlan movedObject(ObjectPlan object, const Placement& placement) {
  for (Body& body : object.bodies) body = movedBody(std::move(body), placement);
  return object;
}

std::uint64_t computeTriangleCount(const Lattice& lattice) {
  const auto nx = static_cast<std::uint64_t>(lattice.cells.x);
  const auto ny = static_cast<std::uint64_t>(lattice.cells.y);
  const auto nz = static_cast<std::uint64_t>(lattice.cells.z);
  if (lattice.topology == Lattice::Topology::kTorus) return 2 * nx * ny;
  if (lattice.removed.empty()) return 4 * (nx * ny + ny * nz + nz * nx);
  std::uint64_t filled = 0, border = 0;
  for (const bool removed : lattice.removed) filled += removed ? 0 : 1;
  visitBorder(lattice, [&](glm::ivec2, glm::ivec2) { ++border; });
  return 4 * filled + 2 * border * nz;
}

void appendBody(const Body& body, double density, std::uint32_t object, TriangleMesh& mesh) {
  const Lattice lattice = body.lattice(density);
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  SurfaceWriter writer(body, lattice, object, mesh);
  if (lattice.topology == Lattice::Topology::kTorus) {
    appendTorus(lattice, writer, first);
  } else {
    appendSolid(lattice, writer);
  }
}

}  // namespace hlodbench::courtyard
