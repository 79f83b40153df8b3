#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "hlod/view/camera.h"

namespace hlodbench {

// A recorded camera session: one pose a frame, replayed by frame index, never by the clock.
// File: JSON, sessions/session.schema.json.
struct Session {
  std::string name;
  Lens lens;
  std::vector<Pose> poses;
};

// Throws InputError with the file and the JSON pointer of what is wrong: a missing file, a wrong
// version, no frame, a number that is not finite, a quaternion whose length is not 1 within 1e-3
// (those within are normalised).
Session readSession(const std::filesystem::path& path);

}  // namespace hlodbench
