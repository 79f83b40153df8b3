#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "hlod/render/block_cache.h"

namespace hlodbench {
namespace {

TEST(RangeAllocator, HandsOutRangesThatDoNotOverlapAndTakesThemBack) {
  std::mt19937 random(1);
  for (int round = 0; round < 20; ++round) {
    const std::uint64_t capacity = 1000 + random() % 1000;
    RangeAllocator allocator(capacity, 200);
    std::map<std::uint64_t, std::uint64_t> taken;  // offset -> size
    std::uint64_t used = 0;
    for (int step = 0; step < 3000; ++step) {
      if (random() % 2 == 0 && taken.size() < 200) {
        const std::uint64_t size = 1 + random() % 60;
        const auto offset = allocator.allocate(size);
        std::uint64_t largest = 0, end = 0;  // gap
        for (const auto& [start, bytes] : taken) {
          largest = std::max(largest, start - end);
          end = start + bytes;
        }
        largest = std::max(largest, capacity - end);
        ASSERT_EQ(offset.has_value(), largest >= size);
        if (!offset) continue;
        taken[*offset] = size;
        used += size;
      } else if (!taken.empty()) {
        const auto gone = std::next(taken.begin(), static_cast<long>(random() % taken.size()));
        allocator.release(gone->first, gone->second);
        used -= gone->second;
        taken.erase(gone);
      }
      std::uint64_t end = 0;
      for (const auto& [start, bytes] : taken) {
        ASSERT_GE(start, end);
        end = start + bytes;
      }
      ASSERT_LE(end, capacity);
      ASSERT_EQ(allocator.freeBytes(), capacity - used);
    }
    for (const auto& [start, bytes] : taken) allocator.release(start, bytes);
    // all gaps have grown together again
    EXPECT_EQ(allocator.gapCount(), 1u);
    EXPECT_EQ(allocator.allocate(capacity), 0u);
    EXPECT_EQ(allocator.allocate(1), std::nullopt);
  }
}

TEST(RangeAllocator, TakesAPlaceThatIsAskedFor) {
  RangeAllocator allocator(100, 4);
  allocator.allocateAt(40, 20);
  EXPECT_EQ(allocator.freeBytes(), 80u);
  EXPECT_EQ(allocator.allocate(41), std::nullopt);
  EXPECT_EQ(allocator.allocate(40), 0u);
  allocator.allocateAt(90, 10);
  EXPECT_EQ(allocator.allocate(30), 60u);
  EXPECT_EQ(allocator.freeBytes(), 0u);
}

TEST(LruList, KeepsTheOrderOfUse) {
  std::mt19937 random(2);
  constexpr std::uint32_t kCount = 20;
  LruList list(kCount);
  std::vector<std::uint32_t> expected;
  for (int step = 0; step < 5000; ++step) {
    const std::uint32_t id = random() % kCount;
    std::erase(expected, id);
    if (random() % 3 == 0) {
      list.remove(id);
    } else {
      list.use(id);
      expected.push_back(id);
    }
    std::vector<std::uint32_t> found;
    for (std::uint32_t at = list.oldest(); at != LruList::kNone; at = list.after(at))
      found.push_back(at);
    ASSERT_EQ(found, expected);
    for (std::uint32_t other = 0; other < kCount; ++other)
      ASSERT_EQ(list.contains(other), std::count(expected.begin(), expected.end(), other) == 1);
  }
}

// A root and 40 nodes of 1 to 8 units of 16 bytes.
Hierarchy makeNodes(std::mt19937& random) {
  Hierarchy h;
  h.nodes.resize(41);
  for (Node& node : h.nodes) node.vertexCount = 1 + random() % 8;
  return h;
}

// What a cache says it holds lies within it and nothing overlaps.
void expectSound(const BlockCache& cache, const Hierarchy& h, std::uint64_t capacity) {
  std::map<std::uint64_t, NodeId> places;
  std::uint64_t bytes = 0;
  for (NodeId id = 0; id < h.nodes.size(); ++id) {
    if (!cache.contains(id)) continue;
    places[cache.offset(id)] = id;
    bytes += h.node(id).blockBytes();
  }
  EXPECT_EQ(bytes, cache.residentBytes());
  std::uint64_t end = 0;
  for (const auto& [offset, id] : places) {
    ASSERT_GE(offset, end);
    end = offset + h.node(id).blockBytes();
  }
  EXPECT_LE(end, capacity);
  EXPECT_TRUE(cache.contains(kRoot));
}

TEST(BlockCache, NeverLosesWhatTheLastFrameOrThisOneUses) {
  std::mt19937 random(3);
  int noRoom = 0;
  for (int round = 0; round < 50; ++round) {
    const Hierarchy h = makeNodes(random);
    const std::uint64_t capacity = computeLeastBudget(h) + 16 * (random() % 60);
    BlockCache cache(h, capacity);
    std::vector<NodeId> last, now;
    for (int frame = 0; frame < 60; ++frame) {
      cache.beginFrame();
      for (int i = 0; i < 6; ++i) {
        const NodeId id = random() % 41;
        if (cache.contains(id)) {
          cache.use(id);
          now.push_back(id);
          continue;
        }
        const std::uint64_t room = cache.room();
        auto placement = cache.place(id);
        // what there is room for finds it, at the latest when the gaps have been closed
        if (placement == BlockCache::Placement::kScattered) {
          cache.compact(~0ull, [](auto...) {});
          placement = cache.place(id);
          ASSERT_NE(placement, BlockCache::Placement::kScattered);
        }
        ASSERT_EQ(placement == BlockCache::Placement::kPlaced, h.node(id).blockBytes() <= room);
        if (placement == BlockCache::Placement::kPlaced)
          now.push_back(id);
        else
          ++noRoom;
      }
      expectSound(cache, h, capacity);
      for (const auto& used : {last, now})
        for (const NodeId id : used) ASSERT_TRUE(cache.contains(id)) << "frame " << frame;
      last = std::move(now);
      now.clear();
    }
    EXPECT_GT(cache.evictions(), 0u);
  }
  EXPECT_GT(noRoom, 0);
}

TEST(BlockCache, TheLeastRecentlyUsedGoFirst) {
  Hierarchy h;
  h.nodes.resize(6);
  for (Node& node : h.nodes) node.vertexCount = 1;
  BlockCache cache(h, 4 * 16);  // the root and three more
  for (const NodeId id : {1u, 2u, 3u}) {
    cache.beginFrame();
    ASSERT_EQ(cache.place(id), BlockCache::Placement::kPlaced);
  }
  cache.beginFrame();
  cache.use(1);
  cache.beginFrame();
  ASSERT_EQ(cache.place(4), BlockCache::Placement::kPlaced);
  EXPECT_FALSE(cache.contains(2));
  ASSERT_EQ(cache.place(5), BlockCache::Placement::kPlaced);
  EXPECT_FALSE(cache.contains(3));
  EXPECT_TRUE(cache.contains(1));  // used in the last frame
  EXPECT_EQ(cache.place(2), BlockCache::Placement::kNoRoom);
  cache.beginBatch();
  EXPECT_EQ(cache.place(2), BlockCache::Placement::kPlaced);
  EXPECT_FALSE(cache.contains(1));
}

TEST(BlockCache, WhatIsOnlyTouchedGoesLastOfThoseThatMayGo) {
  Hierarchy h;
  h.nodes.resize(6);
  for (Node& node : h.nodes) node.vertexCount = 1;
  BlockCache cache(h, 4 * 16);
  for (const NodeId id : {1u, 2u, 3u}) ASSERT_EQ(cache.place(id), BlockCache::Placement::kPlaced);
  cache.beginFrame();
  cache.beginFrame();
  cache.touch(2);
  cache.use(3);
  cache.touch(1);
  ASSERT_EQ(cache.place(4), BlockCache::Placement::kPlaced);
  EXPECT_FALSE(cache.contains(2));
  ASSERT_EQ(cache.place(5), BlockCache::Placement::kPlaced);
  EXPECT_FALSE(cache.contains(1));
  EXPECT_TRUE(cache.contains(3));
}

TEST(BlockCache, MovesBlocksWithoutOverwritingOthers) {
  std::mt19937 random(4);
  int moves = 0;
  for (int round = 0; round < 100; ++round) {
    const Hierarchy h = makeNodes(random);
    const std::uint64_t capacity = computeLeastBudget(h) + 16 * (50 + random() % 100);
    BlockCache cache(h, capacity);
    std::vector<int> memory(capacity, -1);  // the node whose byte it is
    const auto fill = [&](NodeId id) {
      std::fill_n(memory.begin() + static_cast<long>(cache.offset(id)), h.node(id).blockBytes(),
                  id);
    };
    fill(kRoot);
    for (NodeId id = 1; id < 41; ++id)
      if (cache.place(id) == BlockCache::Placement::kPlaced) fill(id);
    // every frame uses half of them; large ones that come make gaps
    for (int frame = 0; frame < 10; ++frame) {
      cache.beginFrame();
      for (NodeId id = 1; id < 41; ++id) {
        if (random() % 2 == 0) continue;
        if (cache.contains(id))
          cache.use(id);
        else if (cache.place(id) == BlockCache::Placement::kPlaced)
          fill(id);
      }
      const std::uint64_t most = random() % 400;
      std::uint64_t moved = 0;
      cache.compact(most, [&](auto from, auto to, auto size) {
        EXPECT_LT(to, from);
        EXPECT_LT(moved, most);
        moved += size;
        ++moves;
        std::copy_n(memory.begin() + static_cast<long>(from), size,
                    memory.begin() + static_cast<long>(to));
      });
      expectSound(cache, h, capacity);
      for (NodeId id = 0; id < 41; ++id)
        if (cache.contains(id)) {
          for (std::uint64_t b = 0; b < h.node(id).blockBytes(); ++b)
            ASSERT_EQ(memory[cache.offset(id) + b], static_cast<int>(id));
        }
    }
  }
  EXPECT_GT(moves, 1000);
}

}  // namespace
}  // namespace hlodbench
