#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace hlodbench {

// Hands out ranges of a stretch of bytes, such as a GPU buffer it knows nothing of. Takes memory
// only when it is made.
class RangeAllocator {
 public:
  // capacity: bytes; most: ranges taken at a time.
  RangeAllocator(std::uint64_t capacity, std::size_t most);

  // The start of a free range of this size (> 0), from the smallest gap that has room; nothing
  // where no gap has, although all of them together may.
  std::optional<std::uint64_t> allocate(std::uint64_t size);
  // Takes a range that must be free.
  void allocateAt(std::uint64_t offset, std::uint64_t size);
  // Gives back a range that was taken.
  void release(std::uint64_t offset, std::uint64_t size);

  [[nodiscard]] std::uint64_t capacity() const { return capacity_; }
  [[nodiscard]] std::uint64_t freeBytes() const { return free_; }
  [[nodiscard]] std::size_t gapCount() const { return gaps_.size(); }

 private:
  struct Gap {
    std::uint64_t offset, size;
  };
  void shrink(std::vector<Gap>::iterator gap, std::uint64_t offset, std::uint64_t size);

  std::uint64_t capacity_, free_;
  std::vector<Gap> gaps_;  // by offset; no two of them touch
};

}  // namespace hlodbench
