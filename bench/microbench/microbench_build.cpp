// What the stages of building cost, on bumpy spheres; items are triangles, or points of a search.

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "hlod/build/hierarchy_builder.h"
#include "hlod/build/surface_distance.h"
#include "hlod/build/welded_mesh.h"

namespace hlodbench {
namespace {

// A grid over the sphere, bent; about `triangles` of them.
TriangleMesh makeBody(std::uint64_t triangles) {
  const auto side = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(triangles) / 2.0));
  TriangleMesh mesh;
  mesh.objectTable.resize(1);
  for (std::uint32_t row = 0; row <= side; ++row) {
    for (std::uint32_t column = 0; column <= side; ++column) {
      const double u = 3.0 * row / side - 1.5, v = 6.0 * column / side - 3.0;
      const double radius = 1.0 + 0.05 * std::sin(17 * u) * std::cos(23 * v);
      mesh.positions.emplace_back(radius * std::cos(u) * std::cos(v),
                                  radius * std::cos(u) * std::sin(v), radius * std::sin(u));
    }
  }
  for (std::uint32_t row = 0; row < side; ++row) {
    for (std::uint32_t column = 0; column < side; ++column) {
      const std::uint32_t a = row * (side + 1) + column, b = a + side + 1;
      mesh.triangles.emplace_back(a, a + 1, b);
      mesh.triangles.emplace_back(a + 1, b + 1, b);
    }
  }
  mesh.objects.resize(mesh.triangles.size(), 0);
  return mesh;
}

std::vector<SceneTriangle> trianglesOf(const TriangleMesh& mesh) {
  std::vector<SceneTriangle> out(mesh.triangles.size());
  MeshTriangles(mesh).read(0, out);
  return out;
}

class NoSink final : public NodeSink {
 public:
  void addGeometry(NodeId, std::span<const Vertex>, std::span<const std::uint32_t>) override {}
};

// range(0): triangles, range(1): threads
void buildWith(benchmark::State& state, const char* simplifier) {
  const TriangleMesh mesh = makeBody(static_cast<std::uint64_t>(state.range(0)));
  BuildOptions options;
  options.simplifier = simplifier;
  options.threads = static_cast<unsigned>(state.range(1));
  for (auto _ : state) {
    NoSink sink;
    BuildReport report;
    benchmark::DoNotOptimize(buildTree(MeshTriangles(mesh), options, sink, report));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(mesh.triangles.size()));
}
BENCHMARK_CAPTURE(buildWith, openmesh, "openmesh")
    ->ArgsProduct({{200'000}, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
#ifdef HLODBENCH_HAVE_MESHOPTIMIZER
BENCHMARK_CAPTURE(buildWith, meshopt, "meshopt")
    ->ArgsProduct({{200'000, 800'000}, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
#endif

void weld(benchmark::State& state) {
  const std::vector<SceneTriangle> triangles =
      trianglesOf(makeBody(static_cast<std::uint64_t>(state.range(0))));
  for (auto _ : state) benchmark::DoNotOptimize(computeWeldedMesh(triangles, 0.5));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(triangles.size()));
}
BENCHMARK(weld)->Arg(100'000)->Unit(benchmark::kMillisecond);

// The nearest of 2000 triangles to points near them, one after the other across the surface.
void nearestTriangle(benchmark::State& state) {
  const TriangleMesh mesh = makeBody(2000);
  std::vector<glm::vec3> corners;
  for (const glm::uvec3& t : mesh.triangles)
    for (int corner = 0; corner < 3; ++corner) corners.push_back(mesh.positions[t[corner]]);
  const SurfaceDistance surface(corners);
  const TriangleMesh points = makeBody(30'000);
  std::uint32_t hint = 0;
  for (auto _ : state)
    for (const glm::vec3& p : points.positions)
      benchmark::DoNotOptimize(surface.distanceSquared(p, 0.0f, hint));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(points.positions.size()));
}
BENCHMARK(nearestTriangle);

}  // namespace
}  // namespace hlodbench
