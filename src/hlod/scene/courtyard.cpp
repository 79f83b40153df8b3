#include "hlod/scene/courtyard.h"

#include <cstdint>
#include <vector>

#include <fmt/format.h>

#include "hlod/core/error.h"
#include "hlod/scene/courtyard_plan.h"
#include "hlod/scene/courtyard_random.h"

namespace hlodbench {
namespace {

using courtyard::ObjectPlan;

constexpr std::uint32_t kLeastTriangles = 50'000, kMostTriangles = 20'000'000;

std::uint64_t countTriangles(const std::vector<ObjectPlan>& plans, double density) {
  std::uint64_t count = 0;
  for (const ObjectPlan& plan : plans) {
    for (const courtyard::Body& body : plan.bodies) {
      count += courtyard::computeTriangleCount(body.lattice(density));
    }
  }
  return count;
}

// The density in cells per metre whose count comes nearest to the wanted one from below; counts
// rise with the density in small steps, since each body rounds its own cells.
double computeDensity(const std::vector<ObjectPlan>& plans, std::uint64_t wanted) {
  double low = 0.05, high = 100.0;
  for (int i = 0; i < 30; ++i) {
    const double middle = 0.5 * (low + high);
    (countTriangles(plans, middle) <= wanted ? low : high) = middle;
  }
  return low;
}

}  // namespace

TriangleMesh generateCourtyard(const CourtyardOptions& options) {
  if (options.triangles < kLeastTriangles || options.triangles > kMostTriangles) {
    throw InputError(fmt::format("courtyard: triangles: expected {} to {}, found {}",
                                 kLeastTriangles, kMostTriangles, options.triangles));
  }
  courtyard::Random random(options.seed);
  std::vector<ObjectPlan> plans;
  courtyard::planBuilding(random.next(), plans);
  courtyard::planGarden(random.next(), plans);
  courtyard::planHalls(random.next(), plans);

  const double density = computeDensity(plans, options.triangles);
  TriangleMesh mesh;
  mesh.triangles.reserve(options.triangles);
  mesh.objects.reserve(options.triangles);
  mesh.positions.reserve(options.triangles / 2 + options.triangles / 16);
  for (const ObjectPlan& plan : plans) {
    const auto object = static_cast<std::uint32_t>(mesh.objectTable.size());
    mesh.objectTable.push_back({plan.name, plan.color});
    for (const courtyard::Body& body : plan.bodies) {
      courtyard::appendBody(body, density, object, mesh);
    }
  }
  return mesh;
}

}  // namespace hlodbench
