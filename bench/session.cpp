#include "session.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "hlod/scene/json_node.h"

namespace hlodbench {
namespace {

constexpr std::uint64_t kLargestViewport = 16384;  // pixels, each way
constexpr double kUnitTolerance = 1e-3;            // of a quaternion's length
constexpr std::size_t kNumbersPerFrame = 7;

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
  pose.orientation /= length;
  return pose;
}

// What is in the file for its readers only: checked, not kept.
void checkRemarks(const JsonNode& root) {
  if (root.has("up") && glm::length(root.at("up").vector3()) == 0.0)
    root.at("up").fail("a direction that is not 0 0 0");
  if (root.has("time_step_s")) root.at("time_step_s").numberAbove0();
  if (root.has("made")) root.at("made").text();
}

}  // namespace

Session readSession(const std::filesystem::path& path) {
  const nlohmann::json json = readJsonFile(path);
  const JsonNode root(json, path.string());
  root.expectObject({"version", "name", "viewport", "fovy_rad", "near", "far", "up", "time_step_s",
                     "made", "frames"});
  root.at("version").integer(1, 1);
  Session session;
  session.name = root.at("name").text();
  session.lens = readLens(root);
  checkRemarks(root);
  const JsonNode frames = root.at("frames");
  const std::size_t count = frames.arraySize(1);
  session.poses.reserve(count);
  for (std::size_t i = 0; i < count; ++i) session.poses.push_back(readPose(frames.at(i)));
  return session;
}

}  // namespace hlodbench
