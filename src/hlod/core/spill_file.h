#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace hlodbench {

// A file without a name, gone when the program ends however it ends: what is written now and read
// again soon. Members throw InputError "FOLDER: cannot be written: reason" and the like.
class SpillFile {
 public:
  // folder: which must exist; the file takes its disk's space.
  explicit SpillFile(std::filesystem::path folder);
  ~SpillFile();
  SpillFile(const SpillFile&) = delete;
  SpillFile& operator=(const SpillFile&) = delete;

  // Returns where the bytes begin. May be called from several threads.
  std::uint64_t append(std::span<const std::byte> bytes);
  // Reads what was written there.
  void read(std::uint64_t offset, std::span<std::byte> bytes) const;

 private:
  [[noreturn]] void fail(const char* what) const;

  std::filesystem::path folder_;
  int fd_;
  std::atomic<std::uint64_t> size_{0};
};

}  // namespace hlodbench
