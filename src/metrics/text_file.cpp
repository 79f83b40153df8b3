#include "metrics/text_file.h"

#include <unistd.h>

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <system_error>

#include "hlod/core/error.h"

namespace hlodbench {

std::string readTextFile(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    throw InputError(fmt::format("{}: expected a file, found a folder", path.string()));
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(fmt::format("{}: cannot be opened for reading", path.string()));
  std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  if (in.bad()) throw InputError(fmt::format("{}: reading failed", path.string()));
  return text;
}

void writeTextFile(const std::filesystem::path& path, std::string_view text) {
  // The process id keeps two programs that write the same result from sharing a temporary file.
  std::filesystem::path temporary = path;
  temporary += fmt::format(".{}.tmp", ::getpid());
  {
    std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
    out.write(text.data(), static_cast<std::streamsize>(text.size()));
    out.close();  // the flush may be what fails
    if (!out) {
      std::error_code ignored;
      std::filesystem::remove(temporary, ignored);
      throw InputError(fmt::format("{}: cannot be written", path.string()));
    }
  }
  std::error_code error;
  std::filesystem::rename(temporary, path, error);
  if (error) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw InputError(fmt::format("{}: cannot be written: {}", path.string(), error.message()));
  }
}

}  // namespace hlodbench
