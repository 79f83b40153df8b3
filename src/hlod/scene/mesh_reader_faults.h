#pragma once

// What is said of faults in a mesh's numbers, by every reader that may find them first.

#include <cstdint>

#include <glm/glm.hpp>

#include "hlod/scene/mesh_reader_parts.h"

namespace hlodbench::mesh_reader {

// All throw InputError; vertices and faces count from 0, of `vertices` and `faces` there are.
[[noreturn]] void failOnCorners(const FileText& file, std::uint64_t face, std::uint64_t corners);
[[noreturn]] void failOnIndex(const FileText& file, std::uint64_t face, std::uint64_t vertices,
                              std::int32_t index);
[[noreturn]] void failOnPosition(const FileText& file, std::uint64_t vertex, const glm::vec3& p);
[[noreturn]] void failOnArea(const FileText& file, std::uint64_t triangles);
[[noreturn]] void failOnMore(const FileText& file, std::uint64_t vertices, std::uint64_t faces,
                             std::uint64_t bytes);

bool isFinite(const glm::vec3& p);
bool hasArea(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

}  // namespace hlodbench::mesh_reader
