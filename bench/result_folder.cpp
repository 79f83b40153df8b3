#include "result_folder.h"

#include <fmt/format.h>

#include "hlod/core/error.h"

namespace hlodbench {

bool makeResultFolder(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  std::error_code error;
  if (fs::exists(folder, error)) {
    if (!fs::is_directory(folder, error))
      throw InputError(fmt::format("--out {}: expected a folder, found a file", folder.string()));
    if (!fs::is_empty(folder, error))
      throw InputError(
          fmt::format("--out {}: expected a new or empty folder, found one with other content",
                      folder.string()));
    return false;
  }
  fs::create_directories(folder, error);
  if (error)
    throw InputError(
        fmt::format("--out {}: cannot be created: {}", folder.string(), error.message()));
  return true;
}

}  // namespace hlodbench
