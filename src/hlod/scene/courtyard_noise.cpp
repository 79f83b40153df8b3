#include "hlod/scene/courtyard_noise.h"

#include <cmath>

#include "hlod/scene/courtyard_random.h"

namespace hlodbench::courtyard {
namespace {

double computeLatticeValue(std::int64_t x, std::int64_t y, std::int64_t z, std::uint64_t seed) {
  const std::uint64_t key = static_cast<std::uint64_t>(x) * 0x8da6b343a1f0c5d5ULL +
                            static_cast<std::uint64_t>(y) * 0xd8163841b7e15162ULL +
                            static_cast<std::uint64_t>(z) * 0xcb1ab31f5ca4a2e9ULL;
  return static_cast<double>(mixBits(key ^ seed) >> 11) * 0x1.0p-52 - 1.0;
}

double fade(double t) {
  return t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
}

// A flat top with rounded shoulders over u in [0, 1]: 0 at both ends.
double computePillow(double u) {
  const double c = 2.0 * u - 1.0;
  const double c2 = c * c;
  return 1.0 - c2 * c2;
}

}  // namespace

double computeNoise(const glm::dvec3& point, std::uint64_t seed) {
  const glm::dvec3 cell = glm::floor(point);
  const glm::dvec3 f = point - cell;
  const auto x = static_cast<std::int64_t>(cell.x);
  const auto y = static_cast<std::int64_t>(cell.y);
  const auto z = static_cast<std::int64_t>(cell.z);
  const double u = fade(f.x), v = fade(f.y), w = fade(f.z);
  double rows[4];
  for (int r = 0; r < 4; ++r) {
    const std::int64_t yy = y + (r & 1), zz = z + (r >> 1);
    const double a = computeLatticeValue(x, yy, zz, seed);
    rows[r] = a + u * (computeLatticeValue(x + 1, yy, zz, seed) - a);
  }
  const double front = rows[0] + v * (rows[1] - rows[0]);
  const double back = rows[2] + v * (rows[3] - rows[2]);
  return front + w * (back - front);
}

double computeFractalNoise(const glm::dvec3& point, int octaves, std::uint64_t seed) {
  double sum = 0.0, height = 1.0, frequency = 1.0;
  for (int i = 0; i < octaves; ++i) {
    sum += height * computeNoise(point * frequency, seed + static_cast<std::uint64_t>(i));
    height *= 0.5;
    frequency *= 2.0;
  }
  return sum;
}

double computeCellValue(std::int64_t x, std::int64_t y, std::uint64_t seed) {
  return computeLatticeValue(x, y, 0, seed);
}

double computeMasonry(double x, double y, double blockLength, double courseHeight,
                      std::uint64_t seed) {
  const double course = std::floor(y / courseHeight);
  const auto row = static_cast<std::int64_t>(course);
  const double along = x / blockLength + ((row & 1) != 0 ? 0.5 : 0.0);
  const double block = std::floor(along);
  const double offset = 0.3 * computeCellValue(static_cast<std::int64_t>(block), row, seed);
  return computePillow(along - block) * computePillow(y / courseHeight - course) * (0.8 + offset);
}

}  // namespace hlodbench::courtyard
