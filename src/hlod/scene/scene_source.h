#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "hlod/core/progress.h"
#include "hlod/scene/triangle_source.h"

namespace hlodbench {

// Opens a scene as readScene() does, but keeps each of its meshes once, however many instances
// there are: these are placed when their triangles are read. The triangles are the same, in the
// same order. Throws InputError as readScene() does; where a transform puts a vertex too far out,
// also when the triangles are read.
std::unique_ptr<TriangleSource> openScene(const std::filesystem::path& path,
                                          const Progress& progress = {});

}  // namespace hlodbench
