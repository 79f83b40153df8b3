#include "hlod/render/range_allocator.h"

#include <algorithm>
#include <cassert>

namespace hlodbench {

RangeAllocator::RangeAllocator(std::uint64_t capacity, std::size_t most)
    : capacity_(capacity), free_(capacity) {
  gaps_.reserve(most + 2);  // one around each range, and one more while it is cut in two
  if (capacity > 0) gaps_.push_back({0, capacity});
}

std::optional<std::uint64_t> RangeAllocator::allocate(std::uint64_t size) {
  auto best = gaps_.end();
  for (auto gap = gaps_.begin(); gap != gaps_.end(); ++gap)
    if (gap->size >= size && (best == gaps_.end() || gap->size < best->size)) best = gap;
  if (best == gaps_.end()) return std::nullopt;
  const std::uint64_t offset = best->offset;
  shrink(best, offset, size);
  return offset;
}

void RangeAllocator::allocateAt(std::uint64_t offset, std::uint64_t size) {
  auto gap = std::upper_bound(gaps_.begin(), gaps_.end(), offset,
                              [](std::uint64_t at, const Gap& g) { return at < g.offset; });
  assert(gap != gaps_.begin());
  --gap;
  assert(gap->offset <= offset && offset + size <= gap->offset + gap->size);
  shrink(gap, offset, size);
}

// Takes a range out of a gap that holds it.
void RangeAllocator::shrink(std::vector<Gap>::iterator gap, std::uint64_t offset,
                            std::uint64_t size) {
  const Gap before{gap->offset, offset - gap->offset};
  const Gap after{offset + size, gap->offset + gap->size - offset - size};
  free_ -= size;
  if (before.size > 0 && after.size > 0) {
    *gap = before;
    gaps_.insert(gap + 1, after);
  } else if (before.size > 0 || after.size > 0) {
    *gap = before.size > 0 ? before : after;
  } else {
    gaps_.erase(gap);
  }
}

void RangeAllocator::release(std::uint64_t offset, std::uint64_t size) {
  free_ += size;
  const auto next = std::upper_bound(gaps_.begin(), gaps_.end(), offset,
                                     [](std::uint64_t at, const Gap& g) { return at < g.offset; });
  const bool joinsNext = next != gaps_.end() && offset + size == next->offset;
  const bool joinsLast = next != gaps_.begin() && (next - 1)->offset + (next - 1)->size == offset;
  if (joinsLast && joinsNext) {
    (next - 1)->size += size + next->size;
    gaps_.erase(next);
  } else if (joinsLast) {
    (next - 1)->size += size;
  } else if (joinsNext) {
    *next = {offset, next->size + size};
  } else {
    gaps_.insert(next, {offset, size});
  }
}

}  // namespace hlodbench
