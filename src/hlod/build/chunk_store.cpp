#include "hlod/build/chunk_store.h"

#include <algorithm>

namespace hlodbench {
namespace {

constexpr std::size_t kStaged = 256;  // triangles that are put away at once

}  // namespace

ChunkStore::ChunkStore(const ChunkPlan& plan, unsigned workers,
                       const std::optional<std::filesystem::path>& folder)
    : used_(plan.chunks.size()) {
  first_.push_back(0);
  for (const std::uint32_t node : plan.chunks)
    first_.push_back(first_.back() + plan.nodes[node].triangles);
  staged_.resize(workers);
  for (auto& lists : staged_) lists.resize(plan.chunks.size());
  if (folder) {
    file_.emplace(*folder);
    return;
  }
  memory_.resize(plan.chunks.size());
  for (std::uint32_t chunk = 0; chunk < memory_.size(); ++chunk) memory_[chunk].resize(size(chunk));
}

void ChunkStore::add(const SceneTriangle& triangle, std::uint32_t chunk, unsigned worker) {
  std::vector<SceneTriangle>& staged = staged_[worker][chunk];
  staged.push_back(triangle);
  if (staged.size() >= kStaged) flush(chunk, staged);
}

void ChunkStore::finish() {
  for (auto& lists : staged_)
    for (std::uint32_t chunk = 0; chunk < lists.size(); ++chunk) flush(chunk, lists[chunk]);
  staged_.clear();
}

void ChunkStore::flush(std::uint32_t chunk, std::vector<SceneTriangle>& staged) {
  if (staged.empty()) return;
  const std::uint64_t at = used_[chunk].fetch_add(staged.size());
  if (file_)
    file_->write((first_[chunk] + at) * sizeof(SceneTriangle), staged.data(),
                 staged.size() * sizeof(SceneTriangle));
  else
    std::copy(staged.begin(), staged.end(),
              memory_[chunk].begin() + static_cast<std::ptrdiff_t>(at));
  staged.clear();
}

std::span<const SceneTriangle> ChunkStore::look(std::uint32_t chunk,
                                                std::vector<SceneTriangle>& scratch) const {
  if (!file_) return memory_[chunk];
  scratch.resize(size(chunk));
  file_->read(first_[chunk] * sizeof(SceneTriangle), scratch.data(),
              scratch.size() * sizeof(SceneTriangle));
  return scratch;
}

std::vector<SceneTriangle> ChunkStore::take(std::uint32_t chunk) {
  if (!file_) return std::move(memory_[chunk]);
  std::vector<SceneTriangle> triangles;
  static_cast<void>(look(chunk, triangles));
  return triangles;
}

}  // namespace hlodbench
