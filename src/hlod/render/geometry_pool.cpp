#include "hlod/render/geometry_pool.h"

#include "hlod/render/gl_debug.h"
#include "hlod/render/gl_fill_buffer.h"

namespace hlodbench {

GeometryPool::GeometryPool(std::span<const std::span<const std::byte>> pages)
    : pages_(pages.size()) {
  for (std::size_t i = 0; i < pages.size(); ++i)
    fillBuffer(GL_ARRAY_BUFFER, pages_[i], "node geometry", pages[i].data(), pages[i].size());
}

GeometryPool::GeometryPool(std::uint64_t capacity, std::uint64_t largestBlock) : pages_(1) {
  fillBuffer(GL_ARRAY_BUFFER, pages_[0], "node geometry", nullptr, capacity, GL_DYNAMIC_DRAW);
  fillBuffer(GL_ARRAY_BUFFER, spare_, "block on the move", nullptr, largestBlock, GL_DYNAMIC_COPY);
}

void GeometryPool::upload(std::uint64_t offset, std::span<const std::byte> block) {
  glBindBuffer(GL_COPY_WRITE_BUFFER, pages_[0]);
  glBufferSubData(GL_COPY_WRITE_BUFFER, static_cast<GLintptr>(offset),
                  static_cast<GLsizeiptr>(block.size()), block.data());
}

void GeometryPool::move(std::uint64_t from, std::uint64_t to, std::uint64_t size) {
  // within one buffer, OpenGL copies only between ranges that do not overlap
  const bool overlap = from < to + size && to < from + size;
  const auto copy = [&](GLuint source, std::uint64_t start, GLuint target, std::uint64_t place) {
    glBindBuffer(GL_COPY_READ_BUFFER, source);
    glBindBuffer(GL_COPY_WRITE_BUFFER, target);
    glCopyBufferSubData(GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER, static_cast<GLintptr>(start),
                        static_cast<GLintptr>(place), static_cast<GLsizeiptr>(size));
  };
  if (overlap) {
    copy(pages_[0], from, spare_, 0);
    copy(spare_, 0, pages_[0], to);
  } else {
    copy(pages_[0], from, pages_[0], to);
  }
}

}  // namespace hlodbench
