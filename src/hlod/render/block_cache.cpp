#include "hlod/render/block_cache.h"

#include <algorithm>

namespace hlodbench {

std::uint64_t computeLeastBudget(const Hierarchy& hierarchy) {
  std::uint64_t largest = 0;
  for (NodeId id = kRoot + 1; id < hierarchy.nodes.size(); ++id)
    largest = std::max(largest, hierarchy.node(id).blockBytes());
  return hierarchy.node(kRoot).blockBytes() + largest;
}

BlockCache::BlockCache(const Hierarchy& hierarchy, std::uint64_t capacity)
    : hierarchy_(hierarchy),
      allocator_(capacity / kBlockAlignment * kBlockAlignment, hierarchy.nodes.size()),
      used_(hierarchy.nodes.size()),
      offsets_(hierarchy.nodes.size(), kAbsent),
      lastUsed_(hierarchy.nodes.size(), 0),
      frameBytes_(sizeOf(kRoot)),
      protectedBytes_(sizeOf(kRoot)) {
  order_.reserve(hierarchy.nodes.size());
  offsets_[kRoot] = allocator_.allocate(sizeOf(kRoot)).value();
  lastUsed_[kRoot] = ~std::uint64_t{0};  // it always counts
}

void BlockCache::beginFrame() {
  protectedFrom_ = frameStart_;
  protectedBytes_ = frameBytes_;
  frameStart_ = ++clock_;
  frameBytes_ = sizeOf(kRoot);
}

void BlockCache::beginBatch() {
  protectedFrom_ = ++clock_;
  protectedBytes_ = sizeOf(kRoot);
}

void BlockCache::use(NodeId id) {
  if (id == kRoot) return;
  if (lastUsed_[id] < protectedFrom_) protectedBytes_ += sizeOf(id);
  if (lastUsed_[id] < frameStart_) frameBytes_ += sizeOf(id);
  lastUsed_[id] = clock_;
  used_.use(id);
}

BlockCache::Placement BlockCache::place(NodeId id) {
  const std::uint64_t size = sizeOf(id);
  if (room() < size) return Placement::kNoRoom;  // before anything goes in vain
  auto offset = allocator_.allocate(size);
  NodeId oldest = used_.oldest();
  while (!offset) {
    if (oldest == LruList::kNone) return Placement::kScattered;
    const NodeId next = used_.after(oldest);
    if (!isProtected(oldest)) {
      evict(oldest);
      offset = allocator_.allocate(size);
    }
    oldest = next;
  }
  offsets_[id] = *offset;
  lastUsed_[id] = 0;
  use(id);
  return Placement::kPlaced;
}

void BlockCache::evict(NodeId id) {
  if (lastUsed_[id] >= frameStart_) frameBytes_ -= sizeOf(id);
  used_.remove(id);
  allocator_.release(offsets_[id], sizeOf(id));
  offsets_[id] = kAbsent;
  ++evictions_;
}

void BlockCache::listByOffset() {
  order_.clear();
  order_.push_back(kRoot);
  for (NodeId id = used_.oldest(); id != LruList::kNone; id = used_.after(id)) order_.push_back(id);
  std::sort(order_.begin(), order_.end(),
            [&](NodeId a, NodeId b) { return offsets_[a] < offsets_[b]; });
}

}  // namespace hlodbench
