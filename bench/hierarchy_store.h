#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "hlod/build/hierarchy_builder.h"
#include "hlod/tree/hierarchy.h"
#include "hlod/tree/hlod_file.h"

namespace hlodbench {

struct StoredHierarchy {
  Hierarchy hierarchy;
  HlodFileInfo info;
  std::string sceneName;
  std::filesystem::path file;
  std::optional<BuildReport> report;  // when it was built now
};

// Brings `file` up to date with the scene: builds it when it is not there, is of another version of
// the format or was made from other input or options, and leaves it alone otherwise. A damaged file
// is refused with the reason.
StoredHierarchy buildOrReuse(const std::filesystem::path& scene, const std::filesystem::path& file,
                             const BuildOptions& options);

// path: an .hlod file, which is read as it is, or a scene or mesh file, whose hierarchy is kept as
// NAME.hlod in `cacheFolder`, NAME.XXXXXXXX.hlod where it is built with other options than the
// defaults.
StoredHierarchy openHierarchy(const std::filesystem::path& path,
                              const std::filesystem::path& cacheFolder,
                              const BuildOptions& options);

// $HLODBENCH_CACHE, or ".cache" in the working directory.
std::filesystem::path getDefaultCacheFolder();

}  // namespace hlodbench
