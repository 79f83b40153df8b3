#include "hlod/render/residency.h"

#include <fmt/format.h>

#include <algorithm>

#include "hlod/core/error.h"

namespace hlodbench {
namespace {

// A frame should not have to wait long for what is let in at its start.
constexpr std::uint64_t kMostPending = std::uint64_t{32} << 20;  // bytes asked for at a time
constexpr std::uint64_t kMostMoved = std::uint64_t{32} << 20;    // bytes a frame

std::optional<BlockCache> makeCache(const Hierarchy& hierarchy, std::uint64_t budget,
                                    std::uint64_t mostPageBytes) {
  const std::uint64_t all = hierarchy.geometry.bytes().size();
  if (budget >= all) return std::nullopt;
  const std::uint64_t least = computeLeastBudget(hierarchy);
  if (budget < least)
    throw InputError(
        fmt::format("--gpu-memory: expected at least {}K for this hierarchy, found {}K",
                    (least + 1023) / 1024, budget / 1024));
  // blocks of a cache move anywhere in it, so it is one page
  return std::optional<BlockCache>(std::in_place, hierarchy,
                                   std::max(least, std::min(budget, mostPageBytes)));
}

GeometryPool makePool(const Hierarchy& hierarchy, const std::optional<BlockCache>& cache,
                      const PageLayout& layout) {
  if (!cache) return GeometryPool(layout.pages);
  std::uint64_t largest = 0;
  for (const Node& node : hierarchy.nodes) largest = std::max(largest, node.blockBytes());
  return {cache->capacity(), largest};
}

}  // namespace

Residency::Residency(const Hierarchy& hierarchy, std::uint64_t budget, std::uint64_t mostPageBytes)
    : hierarchy_(hierarchy),
      cache_(makeCache(hierarchy, budget, mostPageBytes)),
      layout_(cache_ ? PageLayout{} : computePageLayout(hierarchy, mostPageBytes)),
      pool_(makePool(hierarchy, cache_, layout_)) {
  counters_.residentBytes = hierarchy.geometry.bytes().size();
  if (!cache_) {
    for (NodeId id = 0; id < hierarchy.nodes.size(); ++id) checkGeometryHash(hierarchy, id);
    return;
  }
  const std::size_t nodes = hierarchy.nodes.size();
  chosenIn_.assign(nodes, 0);
  wantedIn_.assign(nodes, 0);
  isPending_.assign(nodes, 0);
  for (std::vector<NodeId>* list : {&missing_, &standIns_, &ready_, &requests_})
    list->reserve(nodes);
  upload(kRoot);
  counters_.residentBytes = cache_->residentBytes();
  loader_.emplace(hierarchy);
}

// Checked when it has been copied: what was whole then was whole before, though the file may be cut
// off at any time.
void Residency::upload(NodeId id) {
  pool_.upload(cache_->offset(id), hierarchy_.geometryBytes(hierarchy_.node(id)));
  checkGeometryHash(hierarchy_, id);
}

void Residency::beginFrame() {
  if (!cache_) return;
  ++frame_;
  counters_ = {};
  cache_->beginFrame();
  // Where all that was wanted has room, what stood in for it may go, or the last nodes would never
  // come. Where it has not, stand-ins are the picture.
  const bool fits = wantedBytes_ <= cache_->capacity();
  if (!fits)
    for (const NodeId id : standIns_)
      if (cache_->contains(id)) cache_->use(id);
  loader_->takeReady(ready_);
  std::erase_if(ready_, [&](NodeId id) { return letIn(id); });
  if (!ready_.empty())
    cache_->compact(kMostMoved, [&](auto from, auto to, auto size) { pool_.move(from, to, size); });
  requestMissing(fits);
  missing_.clear();
  standIns_.clear();
  wantedBytes_ = hierarchy_.node(kRoot).blockBytes();
  counters_.residentBytes = cache_->residentBytes();
  counters_.evictions = cache_->evictions() - evictionsBefore_;
  evictionsBefore_ = cache_->evictions();
}

// Whether the node is done with, there or not.
bool Residency::letIn(NodeId id) {
  if (!cache_->contains(id)) {
    switch (cache_->place(id)) {
      case BlockCache::Placement::kPlaced:
        upload(id);
        ++counters_.loads;
        break;
      case BlockCache::Placement::kScattered:
        return false;  // there will be room when blocks have been moved
      case BlockCache::Placement::kNoRoom:
        break;  // it is asked for again if it is missed again
    }
  }
  isPending_[id] = 0;
  pendingBytes_ -= hierarchy_.node(id).blockBytes();
  return true;
}

// The node, or that of its ancestors which is not there while all above it is.
NodeId Residency::findFirstAbsent(NodeId id) const {
  while (!cache_->contains(hierarchy_.node(id).parent)) id = hierarchy_.node(id).parent;
  return id;
}

// Where all that was wanted has room, what was missing is asked for as it was drawn. Where it has
// not, the model is refined from above, a level at a time, as far as there is room: so what stands
// in for missing nodes becomes as fine as it can.
void Residency::requestMissing(bool fits) {
  std::uint64_t room = cache_->room() - std::min(cache_->room(), pendingBytes_);
  requests_.clear();
  for (const NodeId id : missing_) {
    const NodeId node = fits ? id : findFirstAbsent(id);
    const std::uint64_t size = hierarchy_.node(node).blockBytes();
    if (isPending_[node] != 0 || cache_->contains(node) || size > room) continue;
    if (pendingBytes_ > 0 && pendingBytes_ + size > kMostPending) break;
    isPending_[node] = 1;
    pendingBytes_ += size;
    room -= size;
    requests_.push_back(node);
  }
  loader_->request(requests_);
}

NodeId Residency::choose(NodeId wanted) {
  if (!cache_) return wanted;
  NodeId node = wanted;
  const bool isMissing = !cache_->contains(wanted);
  if (wantedIn_[wanted] != frame_) {
    wantedIn_[wanted] = frame_;
    if (wanted != kRoot) wantedBytes_ += hierarchy_.node(wanted).blockBytes();
    if (isMissing) missing_.push_back(wanted);
  }
  if (isMissing) {
    ++counters_.missingNodes;
    while (!cache_->contains(node)) node = hierarchy_.node(node).parent;
    if (chosenIn_[node] == frame_) return kNoNode;
    cache_->touch(node);
    standIns_.push_back(node);
  } else {
    cache_->use(node);
  }
  chosenIn_[node] = frame_;
  return node;
}

std::size_t Residency::loadNow(std::span<const NodeId> nodes) {
  if (!cache_) return nodes.size();
  cache_->beginBatch();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const NodeId id = nodes[i];
    if (cache_->contains(id)) {
      cache_->use(id);
      continue;
    }
    BlockCache::Placement placement = cache_->place(id);
    if (placement == BlockCache::Placement::kScattered) {
      cache_->compact(kUnlimitedMemory,
                      [&](auto from, auto to, auto size) { pool_.move(from, to, size); });
      placement = cache_->place(id);
    }
    if (placement != BlockCache::Placement::kPlaced) return i;
    upload(id);
    ++counters_.loads;
  }
  return nodes.size();
}

}  // namespace hlodbench
