#pragma once

#include <cstdint>

#include <glm/glm.hpp>

namespace hlodbench::courtyard {

// Smooth value noise in [-1, 1] over space; lattice spacing 1, second derivatives continuous.
double computeNoise(const glm::dvec3& point, std::uint64_t seed);

// Sum of `octaves` noises, each of twice the frequency and half the height; within [-2, 2].
double computeFractalNoise(const glm::dvec3& point, int octaves, std::uint64_t seed);

// A number in [-1, 1] that belongs to the cell (x, y).
double computeCellValue(std::int64_t x, std::int64_t y, std::uint64_t seed);

// Height of a wall of pillowed blocks at (x, y) in units of `height`: about 1 within a block of
// blockLength x courseHeight metres, 0 in the joints; every second course is shifted by half a
// block, and every block stands a little further in or out than its neighbours.
double computeMasonry(double x, double y, double blockLength, double courseHeight,
                      std::uint64_t seed);

}  // namespace hlodbench::courtyard
