#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hlod/render/gl_object.h"

namespace hlodbench {

// Buffers of the GPU that hold blocks of geometry; where, others decide.
class GeometryPool {
 public:
  // Buffers that never change. Throws std::runtime_error when the driver has no memory for them.
  explicit GeometryPool(std::span<const std::span<const std::byte>> pages);
  // One buffer of `capacity` bytes to be filled, and one of `largestBlock` bytes to move blocks
  // through. Throws as the other one.
  GeometryPool(std::uint64_t capacity, std::uint64_t largestBlock);

  // These two are of the second kind. Offsets are bytes into the buffer.
  void upload(std::uint64_t offset, std::span<const std::byte> block);
  // The ranges may overlap.
  void move(std::uint64_t from, std::uint64_t to, std::uint64_t size);

  [[nodiscard]] std::span<const GlBuffer> pages() const { return pages_; }

 private:
  std::vector<GlBuffer> pages_;
  GlBuffer spare_;
};

}  // namespace hlodbench
