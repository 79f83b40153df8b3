#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

namespace hlodbench {

// A file's bytes, read when they are looked at. Should the file be cut off by somebody meanwhile,
// looking at what is gone ends the program with one line and exit code 2; see mapping_guard.h. A
// file that is replaced by another of the same name does not matter.
class FileMapping {
 public:
  // fd: the open file, not needed afterwards; bytes: its size. Throws InputError naming the path.
  FileMapping(int fd, std::size_t bytes, std::filesystem::path path);
  ~FileMapping();
  FileMapping(const FileMapping&) = delete;
  FileMapping& operator=(const FileMapping&) = delete;

  [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  std::span<const std::byte> bytes_;
};

}  // namespace hlodbench
