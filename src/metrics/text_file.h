#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace hlodbench {

// The whole file, bytes as they are. Throws InputError naming the file if it cannot be read.
std::string readTextFile(const std::filesystem::path& path);

// Writes to a temporary name in the same folder and renames it, so that whoever reads `path` finds
// the old file or the whole new one, never a part. Throws InputError naming the file, and leaves
// no temporary file, if the folder is missing or the disk is full.
void writeTextFile(const std::filesystem::path& path, std::string_view text);

}  // namespace hlodbench
