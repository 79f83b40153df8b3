#pragma once

namespace hlodbench::shaders {

// Nodes, lit or tinted. The normal is decoded as in hlod/tree/octahedral.h.
inline constexpr const char* kNodeVertex = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec2 normal;
layout(location = 2) in uint object;
uniform mat4 viewProjection;
uniform samplerBuffer colors;
out vec3 worldNormal;
flat out vec3 albedo;
void main() {
  vec2 p = normal / 127.0;
  float z = 1.0 - abs(p.x) - abs(p.y);
  worldNormal = normalize(vec3(p - sign(p) * max(-z, 0.0), z));
  albedo = texelFetch(colors, int(object)).rgb;
  gl_Position = viewProjection * vec4(position, 1.0);
})";

// a sun, and light from the sky and from the ground; both faces are lit as seen
inline constexpr const char* kLitFragment = R"(#version 330 core
in vec3 worldNormal;
flat in vec3 albedo;
out vec4 fragment;
const vec3 kSun = vec3(0.408, 0.816, 0.408);
void main() {
  vec3 n = normalize(gl_FrontFacing ? worldNormal : -worldNormal);
  vec3 sky = mix(vec3(0.20, 0.17, 0.15), vec3(0.42, 0.50, 0.62), 0.5 + 0.5 * n.y);
  vec3 light = sky + vec3(0.72, 0.66, 0.55) * max(0.0, dot(n, kSun));
  fragment = vec4(sqrt(albedo * light), 1.0);
})";

// the same light, without its colour
inline constexpr const char* kTintedFragment = R"(#version 330 core
in vec3 worldNormal;
uniform vec3 tint;
out vec4 fragment;
const vec3 kSun = vec3(0.408, 0.816, 0.408);
void main() {
  vec3 n = normalize(gl_FrontFacing ? worldNormal : -worldNormal);
  float light = mix(0.25, 0.5, 0.5 + 0.5 * n.y) + 0.5 * max(0.0, dot(n, kSun));
  fragment = vec4(sqrt(tint * light), 1.0);
})";

inline constexpr const char* kObjectVertex = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 2) in uint object;
uniform mat4 viewProjection;
flat out uint index;
void main() {
  index = object;
  gl_Position = viewProjection * vec4(position, 1.0);
})";

inline constexpr const char* kObjectFragment = R"(#version 330 core
flat in uint index;
out vec4 fragment;
void main() {
  fragment = vec4(float(index & 255u) / 255.0, float(index >> 8u) / 255.0, 0.0, 1.0);
})";

inline constexpr const char* kFlatFragment = R"(#version 330 core
uniform vec3 tint;
out vec4 fragment;
void main() { fragment = vec4(tint, 1.0); })";

inline constexpr const char* kTriangleFragment = R"(#version 330 core
out vec4 fragment;
void main() {
  uint number = uint(gl_PrimitiveID);
  fragment = vec4(vec3(number & 255u, (number >> 8u) & 255u, (number >> 16u) & 255u) / 255.0, 1.0);
})";

// Boxes, and nodes of which no attribute but the place matters.
inline constexpr const char* kPlainVertex = R"(#version 330 core
layout(location = 0) in vec3 position;
uniform mat4 viewProjection;
void main() { gl_Position = viewProjection * vec4(position, 1.0); })";

inline constexpr const char* kLineVertex = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 color;
uniform mat4 viewProjection;
flat out vec4 shade;
void main() {
  shade = color;
  gl_Position = viewProjection * vec4(position, 1.0);
})";

inline constexpr const char* kLineFragment = R"(#version 330 core
flat in vec4 shade;
uniform float opacity;
out vec4 fragment;
void main() { fragment = vec4(shade.rgb, shade.a * opacity); })";

inline constexpr const char* kBoxFragment = R"(#version 330 core
void main() {})";

}  // namespace hlodbench::shaders
