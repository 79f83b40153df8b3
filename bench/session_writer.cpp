#include "session_writer.h"

#include <fmt/format.h>

#include <initializer_list>
#include <nlohmann/json.hpp>

#include "metrics/text_file.h"
#include "session_json.h"

namespace hlodbench {
namespace {

using nlohmann::json;

// By the JSON library: no locale, the fewest digits, and -0.0 keeps its sign.
std::string formatNumbers(std::initializer_list<double> numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "" : ", ") + json(number).dump();
  return "[" + text + "]";
}

// A name may come from a file's, which need not be UTF-8.
std::string quote(const std::string& text) {
  return json(text).dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace

std::vector<std::string> formatSessionHead(const Session& session) {
  std::vector<std::string> lines{"\"version\": 1", "\"name\": " + quote(session.name)};
  if (session.scene)
    lines.push_back(fmt::format("\"scene\": {{\"name\": {}, \"hash\": {}}}",
                                quote(session.scene->name), quote(session.scene->hash)));
  const Lens& lens = session.lens;
  lines.push_back(fmt::format("\"viewport\": [{}, {}]", lens.width, lens.height));
  lines.push_back("\"fovy_rad\": " + json(lens.fovyRad).dump());
  lines.push_back("\"near\": " + json(lens.nearPlane).dump());
  lines.push_back("\"far\": " + json(lens.farPlane).dump());
  if (session.up)
    lines.push_back("\"up\": " + formatNumbers({session.up->x, session.up->y, session.up->z}));
  if (session.timeStep > 0.0) lines.push_back("\"time_step_s\": " + json(session.timeStep).dump());
  if (!session.made.empty()) lines.push_back("\"made\": " + quote(session.made));
  return lines;
}

std::string formatPose(const Pose& pose) {
  const glm::dvec3& p = pose.position;
  const glm::dquat& q = pose.orientation;
  return formatNumbers({p.x, p.y, p.z, q.x, q.y, q.z, q.w});
}

void writeSession(const std::filesystem::path& path, const Session& session) {
  std::string text = "{\n";
  for (const std::string& line : formatSessionHead(session)) text += "  " + line + ",\n";
  text += "  \"frames\": [";
  const char* separator = "\n";
  for (const Pose& pose : session.poses) {
    text += separator + ("    " + formatPose(pose));
    separator = ",\n";
  }
  writeTextFile(path, text + "\n  ]\n}\n");
}

}  // namespace hlodbench
