#include "hlod/build/node_error.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "hlod/build/node_frame.h"
#include "hlod/build/surface_distance.h"
#include "hlod/build/surface_points.h"

namespace hlodbench {
namespace {

// A few points are measured before the others: the sooner a large distance is known, the sooner the
// search of most points may stop.
constexpr std::size_t kStride = 16;

SurfaceDistance computeSurface(const LodSurface& lod, const NodeFrame& frame) {
  std::vector<glm::vec3> corners;
  corners.reserve(lod.triangles.size() * 3);
  for (const glm::uvec3& t : lod.triangles)
    for (int corner = 0; corner < 3; ++corner)
      corners.push_back(frame.toLocal(lod.mesh.positions[t[corner]]));
  return SurfaceDistance(corners);
}

// What rounding can add to a distance when somebody else measures it: a few units in the last
// place of the largest coordinate.
float roundingOf(const Aabb& box) {
  const glm::vec3 largest = glm::max(glm::abs(box.min), glm::abs(box.max));
  return 4e-7f * std::max({largest.x, largest.y, largest.z});
}

// Measures points and keeps the largest distance. Only the maximum is wanted, so a query may stop
// as soon as it is known not to raise it.
class LargestDistance {
 public:
  explicit LargestDistance(const LodSurface& lod)
      : lod_(lod), frame_(lod.box), surface_(computeSurface(lod, frame_)) {
    const float child = static_cast<float>(lod.childError / frame_.unit());
    largest_ = start_ = child * child;
  }

  [[nodiscard]] glm::vec3 toLocal(const glm::dvec3& point) const { return frame_.toLocal(point); }

  // The triangle of the LOD that is found is the next one's guess.
  void measure(const glm::vec3& local) {
    largest_ = std::max(largest_, surface_.distanceSquared(local, largest_, hint_));
  }

  // Measures a triangle's corners, each once in a node.
  void measureCorners(const glm::uvec3& t, const glm::vec3 (&local)[3], VertexNotes& notes) {
    for (int corner = 0; corner < 3; ++corner) {
      if (notes.has(t[corner])) {
        hint_ = notes.get(t[corner]);
        continue;
      }
      measure(local[corner]);
      notes.set(t[corner], hint_);
    }
  }

  // Measures a point of a triangle whose corners have been measured: what was found for these
  // mostly is near enough.
  void measureInside(const glm::uvec3& t, const glm::vec3& local, const VertexNotes& notes) {
    for (int corner = 0; corner < 3; ++corner)
      if (surface_.distanceSquaredTo(notes.get(t[corner]), local) <= largest_) return;
    measure(local);
  }

  // Whether one triangle of the LOD, one of those found for its corners, is near enough to the
  // whole triangle. The corners have been measured.
  [[nodiscard]] bool isCovered(const glm::uvec3& t, const glm::vec3 (&local)[3],
                               const VertexNotes& notes) const {
    const std::uint32_t found[3] = {notes.get(t.x), notes.get(t.y), notes.get(t.z)};
    for (int guess = 0; guess < 3; ++guess) {
      bool near = true;
      for (int corner = 0; corner < 3 && near; ++corner)
        near = found[corner] == found[guess] ||
               surface_.distanceSquaredTo(found[guess], local[corner]) <= largest_;
      if (near) return true;
    }
    return false;
  }

  [[nodiscard]] float error() const {
    if (largest_ <= start_) return lod_.childError;
    const double measured = std::sqrt(static_cast<double>(largest_)) * frame_.unit();
    return std::max(lod_.childError,
                    static_cast<float>(measured * (1.0 + 1e-4)) + roundingOf(lod_.box));
  }

 private:
  const LodSurface& lod_;
  NodeFrame frame_;
  SurfaceDistance surface_;
  float largest_ = 0.0f;  // squared, in the node's frame
  float start_ = 0.0f;
  std::uint32_t hint_ = 0;
};

}  // namespace

float computeNodeError(const LodSurface& lod, std::span<const glm::uvec3> original,
                       std::uint32_t faceSamples, VertexNotes& notes) {
  LargestDistance distance(lod);
  notes.reset(lod.mesh.positions.size());
  double area = 0.0;
  for (const glm::uvec3& t : original) area += cornersOf(lod.mesh, t).area();
  Random random(original.size() * 0x9e3779b97f4a7c15u ^ std::bit_cast<std::uint64_t>(area));
  const std::uint64_t samples =
      std::clamp<std::uint64_t>(2 * original.size(), faceSamples / 2, faceSamples);
  AreaSteps steps(area, samples, random);
  for (std::size_t i = 0; i < original.size(); i += kStride)
    distance.measure(distance.toLocal(cornersOf(lod.mesh, original[i]).a));
  for (const glm::uvec3& t : original) {
    const Corners corners = cornersOf(lod.mesh, t);
    const glm::vec3 local[3] = {distance.toLocal(corners.a), distance.toLocal(corners.b),
                                distance.toLocal(corners.c)};
    distance.measureCorners(t, local, notes);
    const std::uint64_t here = steps.pass(corners.area());
    if (here == 0 || distance.isCovered(t, local, notes)) continue;
    for (std::uint64_t i = 0; i < here; ++i)
      distance.measureInside(t, distance.toLocal(randomPoint(corners, random)), notes);
  }
  return distance.error();
}

float computeNodeError(const LodSurface& lod, const SurfaceSamples& original) {
  LargestDistance distance(lod);
  for (const std::vector<glm::vec3>* points : {&original.vertices, &original.facePoints}) {
    for (std::size_t i = 0; i < points->size(); i += kStride)
      distance.measure(distance.toLocal((*points)[i]));
    for (const glm::vec3& point : *points) distance.measure(distance.toLocal(point));
  }
  return distance.error();
}

float computeRmsError(const LodSurface& lod, const SurfaceSamples& original) {
  if (original.facePoints.empty()) return lod.childError;
  const NodeFrame frame(lod.box);
  const SurfaceDistance surface = computeSurface(lod, frame);
  std::uint32_t hint = 0;
  double sum = 0.0;
  for (const glm::vec3& point : original.facePoints)
    sum += surface.distanceSquared(frame.toLocal(point), 0.0f, hint);
  const double mean = sum / static_cast<double>(original.facePoints.size());
  return std::max(lod.childError, static_cast<float>(std::sqrt(mean) * frame.unit()));
}

}  // namespace hlodbench
