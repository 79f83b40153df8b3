#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hlod/render/block_cache.h"
#include "hlod/render/block_loader.h"
#include "hlod/render/geometry_pool.h"
#include "hlod/render/page_layout.h"
#include "hlod/tree/hierarchy.h"

namespace hlodbench {

inline constexpr std::uint64_t kUnlimitedMemory = ~std::uint64_t{0};
// Of a buffer of geometry, bytes: far enough below 2 GiB, from where on a driver that counts bytes
// of a vertex buffer in 32 bits with a sign, as llvmpipe does, reads elsewhere and crashes.
inline constexpr std::uint64_t kMostPageBytes = std::uint64_t{1} << 30;

// What became of one frame's nodes.
struct ResidencyCounters {
  std::uint64_t missingNodes = 0;   // drawn as an ancestor, because they were not there
  std::uint64_t loads = 0;          // nodes that came
  std::uint64_t evictions = 0;      // nodes that went
  std::uint64_t residentBytes = 0;  // of nodes, at the frame's start
};

// Keeps nodes' geometry in buffers of the GPU, its pages: all of it where the budget allows it,
// else, in a single one, what was drawn last. A thread reads and checks the nodes that were missed;
// they come when a frame begins. Takes no memory between frames.
class Residency {
 public:
  // budget: bytes for blocks; the GPU holds one more block of the largest size beside them. One
  // that is too small for everything is at most a page. mostPageBytes: of a page, unless one block,
  // or the least budget, is larger. Loads everything, or the root. Throws InputError when a
  // checksum does not match or the budget is under computeLeastBudget(), std::runtime_error when
  // the driver has no memory. The hierarchy must outlive it.
  Residency(const Hierarchy& hierarchy, std::uint64_t budget,
            std::uint64_t mostPageBytes = kMostPageBytes);

  // Lets in what has been read since the last frame, and asks for what that frame missed. Throws
  // InputError when a block was damaged.
  void beginFrame();
  // The node to draw where `wanted` is: itself, or its nearest ancestor that is there; kNoNode
  // where that ancestor has been drawn in this frame already.
  NodeId choose(NodeId wanted);
  // Brings in as many of the nodes (> 0) as fit at a time, at least one, and waits for them: they
  // are there until the next call. Returns how many. May throw as beginFrame().
  std::size_t loadNow(std::span<const NodeId> nodes);

  // Of a node that is there.
  [[nodiscard]] BlockPlace place(NodeId id) const {
    return cache_ ? BlockPlace{0, cache_->offset(id)} : layout_.places[id];
  }
  // Whether nodes come and go.
  [[nodiscard]] bool isLimited() const { return cache_.has_value(); }
  [[nodiscard]] std::span<const GlBuffer> pages() const { return pool_.pages(); }
  [[nodiscard]] const ResidencyCounters& counters() const { return counters_; }

 private:
  void upload(NodeId id);
  bool letIn(NodeId id);
  void requestMissing(bool fits);
  [[nodiscard]] NodeId findFirstAbsent(NodeId id) const;

  const Hierarchy& hierarchy_;
  std::optional<BlockCache> cache_;  // not when everything is there
  PageLayout layout_;                // empty with cache_
  GeometryPool pool_;
  std::vector<std::uint64_t> chosenIn_, wantedIn_;  // by node: the frame of the last time
  std::vector<std::uint8_t> isPending_;             // by node: asked for and not let in yet
  std::vector<NodeId> missing_;                     // in this frame, each once, as they were drawn
  std::vector<NodeId> standIns_;                    // drawn for them, each once
  std::uint64_t wantedBytes_ = 0;                   // of all that this frame wanted
  std::vector<NodeId> ready_, requests_;
  std::uint64_t pendingBytes_ = 0;
  std::uint64_t frame_ = 0;
  std::uint64_t evictionsBefore_ = 0;
  ResidencyCounters counters_;
  std::optional<BlockLoader> loader_;  // with cache_
};

}  // namespace hlodbench
