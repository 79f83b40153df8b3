#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "hlod/scene/courtyard.h"

namespace hlodbench {

// One instance as the scene file says it.
struct InstanceDescription {
  std::string mesh;  // key into SceneDescription::meshes
  std::string name;
  glm::vec3 color{0.75f};   // linear RGB, 0 to 1
  bool normalize = false;   // bring the mesh to unit size on the ground first
  glm::dmat4 placing{1.0};  // then this: scale, rotate, translate, or the file's matrix
  std::string pointer;      // where it stands in the file, for errors
};

// A scene file's content, checked and with its paths resolved, before any mesh is read.
struct SceneDescription {
  std::string name;
  int upAxis = 1;  // of the file: 1 is y, 2 is z
  std::map<std::string, std::filesystem::path> meshes;
  std::vector<InstanceDescription> instances;
  std::optional<CourtyardOptions> courtyard;  // set: a generated scene, without instances
};

// Throws InputError with the file and the JSON pointer of what is wrong.
SceneDescription readSceneDescription(const std::filesystem::path& path);

// A colour for the index-th of many objects: neighbours differ clearly. Linear RGB, 0 to 1.
glm::vec3 choosePaletteColor(std::size_t index);

}  // namespace hlodbench
