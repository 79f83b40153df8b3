#pragma once

#include <cstdint>
#include <vector>

#include "hlod/render/lru_list.h"
#include "hlod/render/range_allocator.h"
#include "hlod/tree/hierarchy.h"

namespace hlodbench {

// Which nodes' blocks are kept in a stretch of memory that is too small for all, and where: those
// used least recently make room, the root stays for ever. Knows nothing of the memory itself. Takes
// memory of its own only when it is made.
class BlockCache {
 public:
  enum class Placement {
    kPlaced,
    kScattered,  // there is room, but in pieces: compact() and ask again
    kNoRoom      // what is there has to stay
  };

  // capacity: bytes, at least what computeLeastBudget() says. The root is placed at once.
  BlockCache(const Hierarchy& hierarchy, std::uint64_t capacity);

  [[nodiscard]] bool contains(NodeId id) const { return offsets_[id] != kAbsent; }
  // Where the block is; the node must be there.
  [[nodiscard]] std::uint64_t offset(NodeId id) const { return offsets_[id]; }

  // From now on, what was used in the last frame and what is used in this one stays.
  void beginFrame();
  // From now on, only what is used from now on stays: for the current frame.
  void beginBatch();
  // Notes that the node, which must be there, is used.
  void use(NodeId id);
  // The same, but it need not stay: it only goes after those not used for longer.
  void touch(NodeId id) {
    if (id != kRoot) used_.use(id);
  }
  // Finds a place for a node that is not there, and makes room for it; it counts as used.
  Placement place(NodeId id);
  // Moves blocks towards the start until the gaps between them are closed or at least `most` bytes
  // were moved. Calls move(from, to, bytes) in an order in which no block overwrites another.
  template <typename Move>
  void compact(std::uint64_t most, Move move);

  // The most bytes that place() could find now: free ones, and those of nodes that need not stay.
  [[nodiscard]] std::uint64_t room() const { return allocator_.capacity() - protectedBytes_; }
  [[nodiscard]] std::uint64_t capacity() const { return allocator_.capacity(); }
  [[nodiscard]] std::uint64_t residentBytes() const {
    return allocator_.capacity() - allocator_.freeBytes();
  }
  // Since it was made.
  [[nodiscard]] std::uint64_t evictions() const { return evictions_; }

 private:
  static constexpr std::uint64_t kAbsent = ~std::uint64_t{0};

  // Whether the node stays, which must be there.
  [[nodiscard]] bool isProtected(NodeId id) const { return lastUsed_[id] >= protectedFrom_; }
  [[nodiscard]] std::uint64_t sizeOf(NodeId id) const { return hierarchy_.node(id).blockBytes(); }
  void evict(NodeId id);
  void listByOffset();

  const Hierarchy& hierarchy_;
  RangeAllocator allocator_;
  LruList used_;                         // all that are there but the root
  std::vector<std::uint64_t> offsets_;   // by node
  std::vector<std::uint64_t> lastUsed_;  // by node: clock_ then
  std::vector<NodeId> order_;            // of compact()
  std::uint64_t clock_ = 1;
  std::uint64_t frameStart_ = 1;               // clock_ when this frame began
  std::uint64_t protectedFrom_ = 1;            // what was used then or later stays
  std::uint64_t frameBytes_, protectedBytes_;  // of nodes there, used since these; root included
  std::uint64_t evictions_ = 0;
};

// The least memory that works: the root stays, and every node must be able to come, bytes.
std::uint64_t computeLeastBudget(const Hierarchy& hierarchy);

template <typename Move>
void BlockCache::compact(std::uint64_t most, Move move) {
  listByOffset();
  std::uint64_t end = 0;  // of the blocks that are packed
  std::uint64_t moved = 0;
  for (const NodeId id : order_) {
    const std::uint64_t size = sizeOf(id);
    if (offsets_[id] != end) {
      if (moved >= most) return;
      move(offsets_[id], end, size);
      allocator_.release(offsets_[id], size);
      allocator_.allocateAt(end, size);
      offsets_[id] = end;
      moved += size;
    }
    end += size;
  }
}

}  // namespace hlodbench
