#pragma once

#include "hlod/tree/hierarchy.h"
#include "hlod/tree/octahedral.h"

namespace hlodbench {

// A vertex as the renderer takes it. normal: unit length.
inline Vertex packVertex(const glm::vec3& position, const glm::vec3& normal, std::uint32_t object) {
  const OctahedralNormal packed = encodeOctahedral(normal);
  return {position, {packed[0], packed[1]}, static_cast<std::uint16_t>(object)};
}

}  // namespace hlodbench
