#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "hlod/core/progress.h"
#include "hlod/scene/mesh_source.h"
#include "hlod/scene/triangle_source.h"

namespace hlodbench {

// Opens a scene as readScene() does, but keeps each of its meshes once, however many instances
// there are, and some not even in memory where `place` wants that: triangles are placed when they
// are read. They are the same, in the same order. Throws InputError as readScene() does; where a
// transform puts a vertex too far out, also when the triangles are read.
std::unique_ptr<TriangleSource> openScene(const std::filesystem::path& path, MeshPlace place,
                                          const Progress& progress = {});

}  // namespace hlodbench
