#pragma once

#include <unistd.h>

#include <cstddef>
#include <filesystem>
#include <string>

namespace hlodbench {

// How much is read or written at a time; the system moves at most 2 GiB in one call.
inline constexpr std::size_t kFileChunk = std::size_t{64} << 20;

// Throws InputError "path: reason".
[[noreturn]] void failOnFile(const std::filesystem::path& path, const std::string& reason);

// What errno says, in words.
std::string systemReason();

// An open file descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  [[nodiscard]] int get() const { return fd_; }
  int close() {
    const int result = fd_ >= 0 ? ::close(fd_) : 0;
    fd_ = -1;
    return result;
  }

 private:
  int fd_;
};

// Removes a file unless it was kept.
class TemporaryFile {
 public:
  explicit TemporaryFile(std::filesystem::path path) : path_(std::move(path)) {}
  ~TemporaryFile() {
    std::error_code ignored;
    if (!kept_) std::filesystem::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  void keep() { kept_ = true; }

 private:
  std::filesystem::path path_;
  bool kept_ = false;
};

// Write or read the whole of a block; throw InputError with the path and the system's reason, or
// that the file ended.
void writeAll(int fd, const void* data, std::size_t bytes, const std::filesystem::path& path);
void readAll(int fd, void* data, std::size_t bytes, const std::filesystem::path& path);

}  // namespace hlodbench
