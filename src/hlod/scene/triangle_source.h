#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "hlod/scene/triangle_mesh.h"

namespace hlodbench {

// One triangle of a scene: 40 bytes, no padding, so that it can be put aside as it is.
struct SceneTriangle {
  glm::vec3 corners[3];      // world units; no coordinate is -0
  std::uint32_t object = 0;  // index into TriangleSource::objects()
};
static_assert(sizeof(SceneTriangle) == 40);

// The triangles of a scene, handed out in any piece, as often as wanted: what a hierarchy is built
// from. The scene itself need not be in memory.
class TriangleSource {
 public:
  virtual ~TriangleSource() = default;
  [[nodiscard]] virtual std::uint64_t triangleCount() const = 0;
  [[nodiscard]] virtual const std::vector<SceneObject>& objects() const = 0;
  // Fills `out` with the triangles from number `first` on. Several threads may call it at once.
  // Throws InputError for a corner that is not finite.
  virtual void read(std::uint64_t first, std::span<SceneTriangle> out) const = 0;
  // What it keeps in memory, about.
  [[nodiscard]] virtual std::uint64_t memoryBytes() const = 0;
  // See computeMeanPartSize().
  [[nodiscard]] virtual double computePartSize() const = 0;
};

// The triangles of a mesh in memory, which is kept by reference.
class MeshTriangles final : public TriangleSource {
 public:
  // Throws InputError for a vertex that is not finite, an index or an object out of range, or a
  // number of objects that is not the number of triangles.
  explicit MeshTriangles(const TriangleMesh& mesh);
  [[nodiscard]] std::uint64_t triangleCount() const override { return mesh_.triangles.size(); }
  [[nodiscard]] const std::vector<SceneObject>& objects() const override {
    return mesh_.objectTable;
  }
  void read(std::uint64_t first, std::span<SceneTriangle> out) const override;
  [[nodiscard]] std::uint64_t memoryBytes() const override {
    return mesh_.positions.size() * 12 + mesh_.triangles.size() * 16;
  }
  [[nodiscard]] double computePartSize() const override;

 private:
  const TriangleMesh& mesh_;
};

}  // namespace hlodbench
