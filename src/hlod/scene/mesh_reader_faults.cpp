#include "hlod/scene/mesh_reader_faults.h"

#include <fmt/format.h>

#include <cmath>

namespace hlodbench::mesh_reader {

void failOnCorners(const FileText& file, std::uint64_t face, std::uint64_t corners) {
  fail(file, fmt::format("face {} (from 0): expected 3 corners or more, found {}", face, corners));
}

void failOnIndex(const FileText& file, std::uint64_t face, std::uint64_t vertices,
                 std::int32_t index) {
  fail(file, fmt::format("face {} (from 0): expected vertices 0 to {}, found vertex {}", face,
                         static_cast<std::int64_t>(vertices) - 1, index));
}

void failOnPosition(const FileText& file, std::uint64_t vertex, const glm::vec3& p) {
  fail(file, fmt::format("vertex {} (from 0): expected finite coordinates, found {} {} {}", vertex,
                         p.x, p.y, p.z));
}

void failOnArea(const FileText& file, std::uint64_t triangles) {
  fail(file, fmt::format("none of the {} triangles has any area", triangles));
}

void failOnMore(const FileText& file, std::uint64_t vertices, std::uint64_t faces,
                std::uint64_t bytes) {
  fail(file, fmt::format("expected the end after {} vertices and {} faces, found {} more bytes",
                         vertices, faces, bytes));
}

bool isFinite(const glm::vec3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

bool hasArea(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  const glm::dvec3 from(a);
  return glm::length(glm::cross(glm::dvec3(b) - from, glm::dvec3(c) - from)) > 0.0;
}

}  // namespace hlodbench::mesh_reader
