#pragma once

#include <atomic>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "hlod/build/chunk_plan.h"
#include "hlod/core/temporary_file.h"

namespace hlodbench {

// The triangles of a scene, sorted into chunks: in memory, or in a temporary file.
class ChunkStore {
 public:
  // folder: where the file goes; none: in memory.
  ChunkStore(const ChunkPlan& plan, unsigned workers,
             const std::optional<std::filesystem::path>& folder);

  // Puts a triangle into its chunk; each worker is one thread.
  void add(const SceneTriangle& triangle, std::uint32_t chunk, unsigned worker);
  // To be called after the last add(), once.
  void finish();

  [[nodiscard]] std::uint64_t size(std::uint32_t chunk) const {
    return first_[chunk + 1] - first_[chunk];
  }
  // The triangles of a chunk, in no particular order. scratch: memory they may be put into.
  [[nodiscard]] std::span<const SceneTriangle> look(std::uint32_t chunk,
                                                    std::vector<SceneTriangle>& scratch) const;
  // The same for the last time: its memory goes to the caller.
  [[nodiscard]] std::vector<SceneTriangle> take(std::uint32_t chunk);

 private:
  void flush(std::uint32_t chunk, std::vector<SceneTriangle>& staged);

  std::vector<std::uint64_t> first_;  // the chunks' places in the file, in triangles; one more
  std::vector<std::atomic<std::uint64_t>> used_;
  std::vector<std::vector<SceneTriangle>> memory_;               // one a chunk
  std::vector<std::vector<std::vector<SceneTriangle>>> staged_;  // one a worker and chunk
  std::optional<TemporaryFile> file_;
};

}  // namespace hlodbench
