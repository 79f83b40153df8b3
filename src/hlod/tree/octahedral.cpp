#include "hlod/tree/octahedral.h"

#include <cmath>

namespace hlodbench {
namespace {

constexpr float kScale = 127.0f;

float signOf(float value) {
  return value >= 0.0f ? 1.0f : -1.0f;
}

// The square's corners hold the lower half.
glm::vec2 foldCorners(const glm::vec2& p) {
  return {(1.0f - std::abs(p.y)) * signOf(p.x), (1.0f - std::abs(p.x)) * signOf(p.y)};
}

}  // namespace

glm::vec3 decodeOctahedral(const OctahedralNormal& code) {
  glm::vec2 p(code[0] / kScale, code[1] / kScale);
  const float z = 1.0f - std::abs(p.x) - std::abs(p.y);
  if (z < 0.0f) p = foldCorners(p);
  return glm::normalize(glm::vec3(p, z));
}

OctahedralNormal encodeOctahedral(const glm::vec3& normal) {
  const float length = std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z);
  const glm::vec3 n = length > 0.0f && std::isfinite(length) ? normal / length : glm::vec3(0, 1, 0);
  glm::vec2 place(n.x, n.y);
  if (n.z < 0.0f) place = foldCorners(place);
  const glm::vec2 low = glm::floor(glm::clamp(place, -1.0f, 1.0f) * kScale);
  OctahedralNormal best{};
  float nearest = -2.0f;
  for (int i = 0; i < 4; ++i) {
    const glm::vec2 rounded = glm::min(low + glm::vec2(i & 1, i >> 1), glm::vec2(kScale));
    const OctahedralNormal code{static_cast<std::int8_t>(rounded.x),
                                static_cast<std::int8_t>(rounded.y)};
    const float cosine = glm::dot(decodeOctahedral(code), n);
    if (cosine > nearest) {
      nearest = cosine;
      best = code;
    }
  }
  return best;
}

}  // namespace hlodbench
