#include "hlod/scene/scene_description.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/gtc/matrix_transform.hpp>
#include <set>

#include "hlod/scene/json_node.h"

namespace hlodbench {
namespace {

constexpr std::uint32_t kLeastCourtyard = 50'000;
constexpr std::uint32_t kMostCourtyard = 20'000'000;

// Puts the environment's values in place of ${NAME} and ${NAME:-text}.
std::string expandVariables(const JsonNode& node) {
  std::string rest = node.text();
  std::string expanded;
  for (std::size_t begin = rest.find("${"); begin != std::string::npos; begin = rest.find("${")) {
    const std::size_t end = rest.find('}', begin);
    if (end == std::string::npos) node.fail("a } after each ${");
    const std::string inside = rest.substr(begin + 2, end - begin - 2);
    const std::size_t dash = inside.find(":-");
    const std::string variable = inside.substr(0, dash);
    const char* value = std::getenv(variable.c_str());
    const bool isSet = value != nullptr && *value != '\0';
    if (!isSet && dash == std::string::npos)
      node.failWith(fmt::format("the environment variable '{}' is not set", variable));
    expanded += rest.substr(0, begin) + (isSet ? std::string(value) : inside.substr(dash + 2));
    rest.erase(0, end + 1);
  }
  return expanded + rest;
}

std::filesystem::path readMeshPath(const JsonNode& node, const std::filesystem::path& folder) {
  node.expectObject({"file"});
  const JsonNode fileNode = node.at("file");
  const std::filesystem::path path = (folder / expandVariables(fileNode)).lexically_normal();
  std::error_code error;
  if (!std::filesystem::exists(path, error)) {
    const bool dragon = path.filename().string().starts_with("dragon_vrip");
    fileNode.failWith(fmt::format("no file {}{}", path.string(),
                                  dragon ? "; scripts/fetch_dragon.sh gets it" : ""));
  }
  return path;
}

glm::dmat4 readMatrix(const JsonNode& node) {
  node.arraySize(16, 16);
  glm::dmat4 matrix;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      matrix[column][row] = node.at(static_cast<std::size_t>(row * 4 + column)).number();
  for (int column = 0; column < 4; ++column)
    if (matrix[column][3] != (column == 3 ? 1.0 : 0.0)) node.fail("a last row of 0 0 0 1");
  const double determinant = glm::determinant(glm::dmat3(matrix));
  if (!std::isfinite(determinant) || determinant == 0.0)
    node.fail("a matrix whose determinant is finite and not 0");
  return matrix;
}

glm::dmat4 readRotation(const JsonNode& node) {
  node.expectObject({"axis", "degrees"});
  const glm::dvec3 axis = node.at("axis").vector3();
  const double length = glm::length(axis);
  if (!(length > 0.0) || !std::isfinite(length)) node.at("axis").fail("an axis that is not 0 0 0");
  const double degrees = node.at("degrees").number();
  return glm::rotate(glm::dmat4(1.0), glm::radians(degrees), axis / length);
}

glm::dvec3 readScale(const JsonNode& node) {
  if (!node.value().is_array()) return glm::dvec3(node.numberAbove0());
  node.arraySize(3, 3);
  return {node.at(0).numberAbove0(), node.at(1).numberAbove0(), node.at(2).numberAbove0()};
}

glm::dmat4 readPlacing(const JsonNode& node) {
  if (node.has("matrix")) {
    for (const char* other : {"translate", "rotate", "scale"})
      if (node.has(other)) node.at(other).failWith("cannot stand beside \"matrix\"");
    return readMatrix(node.at("matrix"));
  }
  glm::dmat4 placing(1.0);
  if (node.has("translate")) placing = glm::translate(placing, node.at("translate").vector3());
  if (node.has("rotate")) placing *= readRotation(node.at("rotate"));
  if (node.has("scale")) placing = glm::scale(placing, readScale(node.at("scale")));
  return placing;
}

glm::vec3 readColor(const JsonNode& node) {
  const glm::dvec3 color = node.vector3();
  for (int i = 0; i < 3; ++i)
    if (color[i] < 0.0 || color[i] > 1.0)
      node.at(static_cast<std::size_t>(i)).fail("a number from 0 to 1");
  return glm::vec3(color);
}

InstanceDescription readInstance(const JsonNode& node, std::size_t index,
                                 const SceneDescription& scene) {
  node.expectObject(
      {"mesh", "name", "color", "normalize", "scale", "rotate", "translate", "matrix"});
  InstanceDescription instance;
  instance.mesh = node.at("mesh").text();
  if (!scene.meshes.contains(instance.mesh)) node.at("mesh").fail("a key of /meshes");
  instance.name =
      node.has("name") ? node.at("name").text() : fmt::format("{} {}", instance.mesh, index);
  instance.color = node.has("color") ? readColor(node.at("color")) : choosePaletteColor(index);
  instance.normalize = node.has("normalize") && node.at("normalize").boolean();
  instance.placing = readPlacing(node);
  instance.pointer = fmt::format("/instances/{}", index);
  return instance;
}

CourtyardOptions readGenerator(const JsonNode& node) {
  node.expectObject({"type", "seed", "triangles"});
  if (node.at("type").text() != "courtyard") node.at("type").fail("\"courtyard\"");
  CourtyardOptions options;
  if (node.has("seed"))
    options.seed = node.at("seed").integer(0, std::numeric_limits<std::uint64_t>::max());
  if (node.has("triangles"))
    options.triangles =
        static_cast<std::uint32_t>(node.at("triangles").integer(kLeastCourtyard, kMostCourtyard));
  return options;
}

void readInstances(const JsonNode& root, const std::filesystem::path& folder,
                   SceneDescription& scene) {
  const JsonNode meshes = root.at("meshes");
  if (!meshes.value().is_object() || meshes.value().empty()) meshes.fail("an object of meshes");
  for (const auto& [key, value] : meshes.value().items())
    scene.meshes[key] = readMeshPath(meshes.at(key), folder);
  const JsonNode instances = root.at("instances");
  const std::size_t count = instances.arraySize(1);
  std::set<std::string> used;
  for (std::size_t i = 0; i < count; ++i) {
    scene.instances.push_back(readInstance(instances.at(i), i, scene));
    used.insert(scene.instances.back().mesh);
  }
  for (const auto& [key, path] : scene.meshes)
    if (!used.contains(key)) meshes.at(key).failWith("no instance uses this mesh");
}

}  // namespace

SceneDescription readSceneDescription(const std::filesystem::path& path) {
  const nlohmann::json json = readJsonFile(path);
  const JsonNode root(json, path.string());
  SceneDescription scene;
  if (json.is_object() && json.contains("generator"))
    root.expectObject({"version", "name", "generator"});
  else
    root.expectObject({"version", "name", "up", "meshes", "instances"});
  root.at("version").integer(1, 1);
  scene.name = root.at("name").text();
  if (root.has("generator")) {
    scene.courtyard = readGenerator(root.at("generator"));
    return scene;
  }
  if (root.has("up")) {
    const std::string up = root.at("up").text();
    if (up != "y" && up != "z") root.at("up").fail("\"y\" or \"z\"");
    scene.upAxis = up == "y" ? 1 : 2;
  }
  readInstances(root, path.parent_path(), scene);
  return scene;
}

glm::vec3 choosePaletteColor(std::size_t index) {
  // Steps of the golden ratio around the hue circle keep any few neighbours well apart.
  constexpr double kGoldenRatio = 0.6180339887498949;
  constexpr double kFirstHue = 0.09;
  constexpr double kSaturation = 0.45;
  constexpr double kValue = 0.85;
  constexpr double kGamma = 2.2;  // the palette is chosen by eye, on a screen
  const double hue = kFirstHue + kGoldenRatio * static_cast<double>(index % 1000);
  glm::vec3 color;
  for (int i = 0; i < 3; ++i) {
    const double turn = hue + 1.0 - i / 3.0;
    const double ramp = std::abs((turn - std::floor(turn)) * 6.0 - 3.0) - 1.0;
    const double shade = kValue * (1.0 - kSaturation * (1.0 - std::clamp(ramp, 0.0, 1.0)));
    color[i] = static_cast<float>(std::pow(shade, kGamma));
  }
  return color;
}

}  // namespace hlodbench
