#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "hlod/core/parallel_for.h"
#include "hlod/scene/triangle_source.h"

namespace hlodbench {

// Calls body(triangles, worker) with all triangles of a source, piece by piece, on `threads`
// threads, in no particular order; worker < threads. report, where given, gets the share done.
template <typename Body>
void passOverScene(const TriangleSource& source, unsigned threads, Body&& body,
                   const std::function<void(double)>& report = {}) {
  constexpr std::uint64_t kPiece = 16384;
  const std::uint64_t pieces = (source.triangleCount() + kPiece - 1) / kPiece;
  std::vector<std::vector<SceneTriangle>> scratch(threads);
  parallelFor(
      pieces, threads,
      [&](std::size_t piece, unsigned worker) {
        const std::uint64_t first = piece * kPiece;
        std::vector<SceneTriangle>& triangles = scratch[worker];
        triangles.resize(std::min(kPiece, source.triangleCount() - first));
        source.read(first, triangles);
        body(std::span<const SceneTriangle>(triangles), worker);
      },
      [&](std::size_t done) {
        if (report) report(static_cast<double>(done) / static_cast<double>(pieces));
      });
}

}  // namespace hlodbench
