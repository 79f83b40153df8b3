#include "hlod/tree/file_mapping.h"

#include <fmt/format.h>
#include <sys/mman.h>

#include "hlod/core/file_io.h"
#include "hlod/tree/mapping_guard.h"

namespace hlodbench {

FileMapping::FileMapping(int fd, std::size_t bytes, std::filesystem::path path)
    : path_(std::move(path)) {
  if (bytes == 0) return;
  void* const start = ::mmap(nullptr, bytes, PROT_READ, MAP_PRIVATE, fd, 0);
  if (start == MAP_FAILED) failOnFile(path_, fmt::format("cannot be mapped: {}", systemReason()));
  bytes_ = {static_cast<const std::byte*>(start), bytes};
  guardMapping(bytes_, path_.string());
}

FileMapping::~FileMapping() {
  if (bytes_.empty()) return;
  unguardMapping(bytes_);
  ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
}

}  // namespace hlodbench
