#pragma once

#include <cmath>
#include <vector>

#include "hlod/tree/hierarchy.h"

namespace hlodbench {

// A vertex as the renderer takes it. normal: unit length.
inline Vertex packVertex(const glm::vec3& position, const glm::vec3& normal, std::uint32_t object,
                         const std::vector<SceneObject>& objects) {
  Vertex out;
  out.position = position;
  for (int axis = 0; axis < 3; ++axis)
    out.normal[axis] =
        static_cast<std::int16_t>(std::lround(glm::clamp(normal[axis], -1.0f, 1.0f) * 32767.0f));
  out.object = static_cast<std::uint16_t>(object & 0xffffu);
  for (int channel = 0; channel < 3; ++channel)
    out.color[channel] = static_cast<std::uint8_t>(
        std::lround(glm::clamp(objects[object].color[channel], 0.0f, 1.0f) * 255.0f));
  out.color[3] = 255;
  return out;
}

}  // namespace hlodbench
