#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

namespace hlodbench {

// A file for data that does not fit into memory. It has no name from the start, or loses it right
// after opening, so nothing is left of it, however the program ends.
class TemporaryFile {
 public:
  // folder: which must exist, "" for the working directory; the file takes its disk's space. Throws
  // InputError when no file can be made there.
  explicit TemporaryFile(std::filesystem::path folder);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  // Both may be called by several threads at once; offset in bytes. Throw InputError with the
  // folder and the reason.
  void write(std::uint64_t offset, const void* data, std::size_t bytes);
  void read(std::uint64_t offset, void* data, std::size_t bytes) const;

 private:
  [[noreturn]] void fail(const char* what, int reason) const;

  std::filesystem::path folder_;
  int fd_ = -1;
};

}  // namespace hlodbench
