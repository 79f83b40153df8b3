#include "hlod/tree/file_io.h"

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

void readAll(int fd, void* data, std::size_t bytes, const std::filesystem::path& path) {
  char* at = static_cast<char*>(data);
  while (bytes > 0) {
    const ssize_t got = ::read(fd, at, std::min(bytes, kFileChunk));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) failOnFile(path, fmt::format("cannot read: {}", systemReason()));
    if (got == 0) failOnFile(path, "truncated while it was read");
    at += got;
    bytes -= static_cast<std::size_t>(got);
  }
}

}  // namespace hlodbench
