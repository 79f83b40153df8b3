#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "hlod/tree/hierarchy.h"

namespace hlodbench {

// What a hierarchy file says about itself.
struct HlodFileInfo {
  std::uint64_t sceneHash = 0;    // of the scene it was built from, as computeSceneHash() gives it
  std::string options;            // canonical build options, one line, under 64 KiB
  std::uint32_t version = 0;      // of the format; set when writing and reading
  std::uint64_t contentHash = 0;  // XXH3 of everything else; identifies the hierarchy in traces.
                                  // Set when writing and reading
};

// The format written and read; files of another are refused, they are quickly built anew.
inline constexpr std::uint32_t kHlodFileVersion = 2;

// Opens a hierarchy; info, where given, is filled. Its geometry is mapped, not read: blocks are
// checked by checkGeometryHash() when they are first used. Throws InputError with the path and the
// reason: missing, no hierarchy file, another version, another size than its header says, a
// checksum of header or tables that does not match.
Hierarchy readHlodFile(const std::filesystem::path& path, HlodFileInfo* info = nullptr);

// Reads the header only: cheap, and enough to see whether the file is the wanted one. Checks
// everything that readHlodFile() does but the tables.
HlodFileInfo readHlodFileInfo(const std::filesystem::path& path);

// Whether the file is there and a hierarchy, of a version that is not kHlodFileVersion. Throws
// nothing.
bool isOtherHlodVersion(const std::filesystem::path& path);

}  // namespace hlodbench
