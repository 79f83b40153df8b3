#include "session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>

#include "hlod/scene/json_node.h"
#include "session_json.h"

namespace hlodbench {
namespace {

constexpr std::uint64_t kLargestViewport = 16384;  // pixels, each way
constexpr double kUnitTolerance = 1e-3;            // of a quaternion's length
constexpr std::size_t kNumbersPerFrame = 7;
constexpr std::size_t kHashDigits = 16;
// What normalising leaves of a length's difference from 1.
constexpr double kUnitRounding = 4.0 * std::numeric_limits<double>::epsilon();

Lens readLens(const JsonNode& root) {
  Lens lens;
  const JsonNode viewport = root.at("viewport");
  viewport.arraySize(2, 2);
  lens.width = static_cast<int>(viewport.at(0).integer(1, kLargestViewport));
  lens.height = static_cast<int>(viewport.at(1).integer(1, kLargestViewport));
  const JsonNode fovy = root.at("fovy_rad");
  lens.fovyRad = fovy.number();
  if (lens.fovyRad <= 0.0 || lens.fovyRad >= glm::pi<double>())
    fovy.fail("a number of radians above 0 and below pi");
  lens.nearPlane = root.at("near").numberAbove0();
  lens.farPlane = root.at("far").number();
  if (lens.farPlane <= lens.nearPlane)
    root.at("far").fail(fmt::format("a number above /near, which is {}", lens.nearPlane));
  return lens;
}

SessionScene readScene(const JsonNode& node) {
  node.expectObject({"name", "hash"});
  SessionScene scene{node.at("name").text(), node.at("hash").text()};
  const bool isHash = scene.hash.size() == kHashDigits &&
                      scene.hash.find_first_not_of("0123456789abcdef") == std::string::npos;
  if (!isHash) node.at("hash").fail(fmt::format("{} hex digits in lower case", kHashDigits));
  return scene;
}

// A name goes into a message of one line.
std::string putInOneLine(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' '; }, ' ');
  return text;
}

}  // namespace

Pose readPose(const JsonNode& node) {
  node.arraySize(kNumbersPerFrame, kNumbersPerFrame);
  double numbers[kNumbersPerFrame];
  for (std::size_t i = 0; i < kNumbersPerFrame; ++i) numbers[i] = node.at(i).number();
  Pose pose;
  pose.position = {numbers[0], numbers[1], numbers[2]};
  // The file has x y z w, glm's constructor w x y z.
  pose.orientation = glm::dquat(numbers[6], numbers[3], numbers[4], numbers[5]);
  const double length = glm::length(pose.orientation);
  if (!(std::abs(length - 1.0) <= kUnitTolerance))
    node.failWith(
        fmt::format("expected a quaternion (the last 4 numbers) of length 1, found {}", length));
  if (std::abs(length - 1.0) > kUnitRounding) pose.orientation /= length;
  return pose;
}

Session readSessionHead(const JsonNode& root) {
  root.expectObject({"version", "name", "scene", "viewport", "fovy_rad", "near", "far", "up",
                     "time_step_s", "made", "frames"});
  root.at("version").integer(1, 1);
  Session session;
  session.name = root.at("name").text();
  if (root.has("scene")) session.scene = readScene(root.at("scene"));
  session.lens = readLens(root);
  if (root.has("up")) {
    session.up = root.at("up").vector3();
    if (glm::length(*session.up) == 0.0) root.at("up").fail("a direction that is not 0 0 0");
  }
  if (root.has("time_step_s")) session.timeStep = root.at("time_step_s").numberAbove0();
  if (root.has("made")) session.made = root.at("made").text();
  return session;
}

Session readSession(const std::filesystem::path& path) {
  const nlohmann::json json = readJsonFile(path);
  const JsonNode root(json, path.string());
  Session session = readSessionHead(root);
  const JsonNode frames = root.at("frames");
  const std::size_t count = frames.arraySize(1);
  session.poses.reserve(count);
  for (std::size_t i = 0; i < count; ++i) session.poses.push_back(readPose(frames.at(i)));
  return session;
}

std::string describeOtherScene(const Session& session, const std::string& sceneName,
                               std::uint64_t sceneHash) {
  const std::string hash = fmt::format("{:016x}", sceneHash);
  if (!session.scene || session.scene->hash == hash) return "";
  return putInOneLine(
      fmt::format("the session '{}' was recorded in scene '{}' ({}), this is '{}' ({})",
                  session.name, session.scene->name, session.scene->hash, sceneName, hash));
}

}  // namespace hlodbench
