#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <string_view>

namespace hlodbench {

// A file being written that appears under its name only when it is whole: it is written to a
// temporary name in the same folder and renamed by commit(). Whatever happens before that, an
// exception or a full disk, whoever reads `path` finds what was there before, and no temporary
// file is left. All members throw InputError "path: cannot be written: reason".
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(const void* data, std::size_t bytes);
  void write(std::string_view text) { write(text.data(), text.size()); }
  // Replaces the first bytes, of which at least as many must have been written; what is written
  // next goes to the end again.
  void rewriteStart(const void* data, std::size_t bytes);
  void commit();

 private:
  [[noreturn]] void fail(int reason);
  void discard();

  std::filesystem::path path_, temporary_;
  std::FILE* file_;
};

}  // namespace hlodbench
