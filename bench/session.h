#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hlod/view/camera.h"

namespace hlodbench {

// The scene in which a path was recorded.
struct SessionScene {
  std::string name;
  std::string hash;  // 16 hex digits in lower case, the scene hash that .hlod files store
};

// A recorded camera session: one pose a frame, replayed by frame index, never by the clock.
// File: JSON, sessions/session.schema.json.
struct Session {
  std::string name;  // not empty
  std::optional<SessionScene> scene;
  Lens lens;
  std::optional<glm::dvec3> up;  // that the poses were made with; any length but 0
  double timeStep = 0.0;         // seconds between frames when the path was made; 0: not said
  std::string made;              // how it was made; empty: not said
  std::vector<Pose> poses;
};

// Throws InputError with the file and the JSON pointer of what is wrong: a missing file, a wrong
// version, no frame, a number that is not finite, a quaternion whose length is not 1 within 1e-3
// (those within are normalised).
Session readSession(const std::filesystem::path& path);

// One line that says so if the session was recorded in another scene than this one, else "": also
// where the session does not say.
std::string describeOtherScene(const Session& session, const std::string& sceneName,
                               std::uint64_t sceneHash);

}  // namespace hlodbench
