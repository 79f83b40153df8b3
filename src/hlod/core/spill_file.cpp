#include "hlod/core/spill_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "hlod/core/error.h"

namespace hlodbench {
namespace {

constexpr std::size_t kMost = std::size_t{1} << 30;  // that the system moves in one call

int openUnnamed(const std::filesystem::path& folder) {
  std::string name = (folder / "hlodbench.XXXXXX").string();
  const int fd = ::mkostemp(name.data(), O_CLOEXEC);
  if (fd >= 0) ::unlink(name.c_str());
  return fd;
}

}  // namespace

SpillFile::SpillFile(std::filesystem::path folder)
    : folder_(folder.empty() ? "." : std::move(folder)), fd_(openUnnamed(folder_)) {
  if (fd_ < 0) fail("cannot be written");
}

SpillFile::~SpillFile() {
  if (fd_ >= 0) ::close(fd_);
}

std::uint64_t SpillFile::append(std::span<const std::byte> bytes) {
  const std::uint64_t start = size_.fetch_add(bytes.size());
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t wrote = ::pwrite(fd_, bytes.data() + done, std::min(bytes.size() - done, kMost),
                                   static_cast<off_t>(start + done));
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote < 0) fail("cannot be written");
    done += static_cast<std::size_t>(wrote);
  }
  return start;
}

void SpillFile::read(std::uint64_t offset, std::span<std::byte> bytes) const {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t got = ::pread(fd_, bytes.data() + done, std::min(bytes.size() - done, kMost),
                                static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got == 0) errno = EIO;
    if (got <= 0) fail("cannot be read again");
    done += static_cast<std::size_t>(got);
  }
}

void SpillFile::fail(const char* what) const {
  throw InputError(fmt::format("{}: a temporary file in it {}: {}", folder_.string(), what,
                               std::strerror(errno)));
}

}  // namespace hlodbench
