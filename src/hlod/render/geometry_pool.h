#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hlod/render/gl_object.h"

namespace hlodbench {

// One buffer of the GPU that holds blocks of geometry; where, others decide.
class GeometryPool {
 public:
  // A buffer that never changes. Throws std::runtime_error when the driver has no memory for it.
  explicit GeometryPool(std::span<const std::byte> bytes);
  // A buffer of `capacity` bytes to be filled, and one of `largestBlock` bytes to move blocks
  // through. Throws as the other one.
  GeometryPool(std::uint64_t capacity, std::uint64_t largestBlock);

  void upload(std::uint64_t offset, std::span<const std::byte> block);
  // The ranges may overlap.
  void move(std::uint64_t from, std::uint64_t to, std::uint64_t size);

  [[nodiscard]] GLuint buffer() const { return buffer_; }

 private:
  GlBuffer buffer_, spare_;
};

}  // namespace hlodbench
