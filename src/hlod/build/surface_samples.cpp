#include "hlod/build/surface_samples.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "hlod/build/random.h"
#include "hlod/build/surface_points.h"

namespace hlodbench {
namespace {

// The fewest of a set: few triangles may have much of the area.
constexpr std::uint64_t kLeastSamples = 1024;

// Appends `wanted` of the points, one of every equal piece of the list, or all where they are not
// more.
void choose(const std::vector<glm::vec3>& from, std::uint64_t wanted, Random& random,
            std::vector<glm::vec3>& to) {
  if (wanted >= from.size()) {
    to.insert(to.end(), from.begin(), from.end());
    return;
  }
  const double step = static_cast<double>(from.size()) / static_cast<double>(wanted);
  for (std::uint64_t i = 0; i < wanted; ++i) {
    const auto at = static_cast<std::size_t>((static_cast<double>(i) + random.next()) * step);
    to.push_back(from[std::min(at, from.size() - 1)]);
  }
}

std::uint64_t seedOf(std::uint64_t triangles, double area) {
  return triangles * 0x9e3779b97f4a7c15u ^ std::bit_cast<std::uint64_t>(area);
}

}  // namespace

SurfaceSamples takeSamples(const WeldedMesh& mesh, std::span<const glm::uvec3> triangles,
                           std::uint32_t most) {
  SurfaceSamples out;
  out.triangles = triangles.size();
  for (const glm::uvec3& t : triangles) out.area += cornersOf(mesh, t).area();
  const std::uint64_t wanted =
      std::min<std::uint64_t>(most, std::max<std::uint64_t>(kLeastSamples, triangles.size()));
  Random random(seedOf(out.triangles, out.area));
  out.facePoints.reserve(wanted);
  AreaSteps steps(out.area, wanted, random);
  for (const glm::uvec3& t : triangles) {
    const Corners corners = cornersOf(mesh, t);
    for (std::uint64_t i = steps.pass(corners.area()); i > 0; --i)
      out.facePoints.emplace_back(randomPoint(corners, random));
  }
  const std::uint64_t cornerCount = triangles.size() * 3;
  const std::uint64_t vertices = std::min<std::uint64_t>(most / 2, triangles.size());
  const double step = static_cast<double>(cornerCount) / static_cast<double>(vertices);
  out.vertices.reserve(vertices);
  for (std::uint64_t i = 0; i < vertices; ++i) {
    const auto corner =
        std::min(cornerCount - 1,
                 static_cast<std::uint64_t>((static_cast<double>(i) + random.next()) * step));
    const auto axis = static_cast<int>(corner % 3);
    out.vertices.push_back(mesh.positions[triangles[corner / 3][axis]]);
  }
  return out;
}

SurfaceSamples joinSamples(std::span<const SurfaceSamples* const> sets, std::uint32_t most) {
  SurfaceSamples out;
  for (const SurfaceSamples* set : sets) {
    out.area += set->area;
    out.triangles += set->triangles;
  }
  Random random(seedOf(out.triangles, out.area));
  for (const SurfaceSamples* set : sets) {
    const double byArea = out.area > 0.0 ? set->area / out.area : 1.0;
    const double byCount = static_cast<double>(set->triangles) / static_cast<double>(out.triangles);
    choose(set->facePoints, static_cast<std::uint64_t>(std::lround(most * byArea)), random,
           out.facePoints);
    choose(set->vertices, static_cast<std::uint64_t>(std::lround(0.5 * most * byCount)), random,
           out.vertices);
  }
  return out;
}

}  // namespace hlodbench
