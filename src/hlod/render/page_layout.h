#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hlod/tree/hierarchy.h"

namespace hlodbench {

// Where a block of geometry lies on the GPU: in which buffer, and how many bytes into it.
struct BlockPlace {
  std::uint32_t page = 0;
  std::uint64_t offset = 0;
};

// A hierarchy's geometry in several buffers.
struct PageLayout {
  std::vector<BlockPlace> places;                 // by node
  std::vector<std::span<const std::byte>> pages;  // parts of the hierarchy's geometry
};

// No page has more than `most` bytes, but for a block that is larger: no block is split, and that
// one has a page to itself. The hierarchy has a node at least.
PageLayout computePageLayout(const Hierarchy& hierarchy, std::uint64_t most);

}  // namespace hlodbench
