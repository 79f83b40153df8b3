#include "hlod/core/file_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "hlod/core/error.h"

namespace hlodbench {

void failOnFile(const std::filesystem::path& path, const std::string& reason) {
  throw InputError(fmt::format("{}: {}", path.string(), reason));
}

std::string systemReason() {
  return std::strerror(errno);
}

void readAt(int fd, std::uint64_t offset, void* data, std::size_t bytes,
            const std::filesystem::path& path) {
  char* at = static_cast<char*>(data);
  while (bytes > 0) {
    const ssize_t got = ::pread(fd, at, std::min(bytes, kFileChunk), static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) failOnFile(path, fmt::format("cannot read: {}", systemReason()));
    if (got == 0) failOnFile(path, "truncated while it was read");
    at += got;
    offset += static_cast<std::uint64_t>(got);
    bytes -= static_cast<std::size_t>(got);
  }
}

}  // namespace hlodbench
