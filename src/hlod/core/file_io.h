#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>

namespace hlodbench {

// How much is read at a time; the system moves at most 2 GiB in one call.
inline constexpr std::size_t kFileChunk = std::size_t{64} << 20;

// Throws InputError "path: reason".
[[noreturn]] void failOnFile(const std::filesystem::path& path, const std::string& reason);

// What errno says, in words.
std::string systemReason();

// An open file descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  [[nodiscard]] int get() const { return fd_; }

 private:
  int fd_;
};

// Reads the whole of a block, which begins at `offset` bytes; several threads may do so at once.
// Throws InputError with the path and the system's reason, or that the file ended.
void readAt(int fd, std::uint64_t offset, void* data, std::size_t bytes,
            const std::filesystem::path& path);

}  // namespace hlodbench
