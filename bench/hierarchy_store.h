#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "hlod/build/hierarchy_builder.h"
#include "hlod/core/progress.h"
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
// is refused with the reason. Progress is printed, and told to onProgress, which ends the building
// by throwing.
StoredHierarchy buildOrReuse(const std::filesystem::path& scene, const std::filesystem::path& file,
                             const BuildOptions& options, const Progress& onProgress = {});

// path: an .hlod file, which is read as it is, or a scene or mesh file, whose hierarchy is kept as
// NAME.hlod in `cacheFolder`, NAME.XXXXXXXX.hlod where it is built with other options than the
// defaults. onProgress: as above.
StoredHierarchy openHierarchy(const std::filesystem::path& path,
                              const std::filesystem::path& cacheFolder, const BuildOptions& options,
                              const Progress& onProgress = {});

// $HLODBENCH_CACHE, or ".cache" in the working directory.
std::filesystem::path getDefaultCacheFolder();

}  // namespace hlodbench
