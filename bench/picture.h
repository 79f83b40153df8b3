#pragma once

#include <filesystem>

#include "hlod/render/framebuffer.h"

namespace hlodbench {

// Writes an image through OpenImageIO, in the format that the file's extension names (PNG,
// ...). The file appears under its name only when it is whole. Throws InputError with the file and
// the reason.
void writePicture(const std::filesystem::path& path, const Image& image);

}  // namespace hlodbench
