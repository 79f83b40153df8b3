#pragma once

#include <array>
#include <cstdint>

#include <glm/glm.hpp>

namespace hlodbench {

// Unit vectors in two signed normalised bytes, by their place on an octahedron that is unfolded to
// a square: Z. H. Cigolle, S. Donow, D. Evangelakos, M. Mara, M. McGuire, Q. Meyer. A Survey of
// Efficient Representations for Independent Unit Vectors. JCGT 3(2), 2014. Values are -127 to 127;
// no vector is off by more than 1.1 degrees.
using OctahedralNormal = std::array<std::int8_t, 2>;

// The code nearest to a vector, of the four around its place. normal: of any length above 0; what
// has no direction counts as +y.
OctahedralNormal encodeOctahedral(const glm::vec3& normal);

// Unit length. The node vertex shader does the same.
glm::vec3 decodeOctahedral(const OctahedralNormal& code);

}  // namespace hlodbench
