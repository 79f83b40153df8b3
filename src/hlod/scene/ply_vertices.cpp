#include "hlod/scene/ply_vertices.h"

#include <algorithm>

#include "hlod/core/file_io.h"

namespace hlodbench::mesh_reader {
namespace {

// At most so much is read at once, and no more for one vertex than is faster than a call for it.
constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 20;
constexpr std::uint64_t kBytesAVertex = 4096;

}  // namespace

void PlyVertexReader::read(std::span<WantedVertex> wanted, std::span<SceneTriangle> out) {
  const auto byVertex = [](const WantedVertex& a, const WantedVertex& b) {
    return a.vertex < b.vertex;
  };
  const auto [least, most] = std::minmax_element(wanted.begin(), wanted.end(), byVertex);
  const std::uint32_t first = least->vertex;
  const std::uint32_t last = most->vertex;
  const std::uint64_t bytes = (std::uint64_t{last} - first + 1) * layout_.vertices.size;
  if (first < last && bytes > std::min(kMostBytes, wanted.size() * kBytesAVertex)) {
    const std::uint32_t middle = first + (last - first) / 2;
    const auto upper =
        std::partition(wanted.begin(), wanted.end(),
                       [middle](const WantedVertex& want) { return want.vertex <= middle; });
    const auto lower = static_cast<std::size_t>(upper - wanted.begin());
    read(wanted.first(lower), out);
    read(wanted.subspan(lower), out);
    return;
  }
  if (window_.size() < bytes) window_.resize(bytes);
  readAt(fd_, layout_.vertices.begin + first * layout_.vertices.size, window_.data(), bytes, path_);
  for (const WantedVertex& want : wanted)
    out[want.corner / 3].corners[want.corner % 3] =
        layout_.position(window_.data() + (want.vertex - first) * layout_.vertices.size);
}

}  // namespace hlodbench::mesh_reader
