#include "hlod/core/atomic_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "hlod/core/error.h"

namespace hlodbench {

// The process's number keeps two programs that write the same file apart.
AtomicFile::AtomicFile(std::filesystem::path path)
    : path_(std::move(path)),
      temporary_(path_.string() + fmt::format(".{}.tmp", ::getpid())),
      file_(std::fopen(temporary_.c_str(), "wbe")) {
  if (file_ == nullptr) fail(errno);
}

AtomicFile::~AtomicFile() {
  discard();
}

void AtomicFile::write(const void* data, std::size_t bytes) {
  if (bytes > 0 && std::fwrite(data, 1, bytes, file_) != bytes) fail(errno);
}

void AtomicFile::rewriteStart(const void* data, std::size_t bytes) {
  if (std::fseek(file_, 0, SEEK_SET) != 0) fail(errno);
  write(data, bytes);
  if (std::fseek(file_, 0, SEEK_END) != 0) fail(errno);
}

void AtomicFile::commit() {
  // the flush may be what fails
  if (std::fflush(file_) != 0) fail(errno);
  const bool isClosed = std::fclose(file_) == 0;
  const int closeError = errno;
  file_ = nullptr;
  std::error_code error;
  if (isClosed) std::filesystem::rename(temporary_, path_, error);
  if (isClosed && !error) return;
  const int reason = isClosed ? error.value() : closeError;
  std::filesystem::remove(temporary_, error);
  fail(reason);
}

void AtomicFile::fail(int reason) {
  discard();
  throw InputError(fmt::format("{}: cannot be written: {}", path_.string(), std::strerror(reason)));
}

void AtomicFile::discard() {
  if (file_ == nullptr) return;
  std::fclose(file_);
  file_ = nullptr;
  std::error_code ignored;
  std::filesystem::remove(temporary_, ignored);
}

}  // namespace hlodbench
