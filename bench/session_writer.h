#pragma once

#include <filesystem>

#include "session.h"

namespace hlodbench {

// Writes a session file, one frame a line, which is there whole or not at all. The session is what
// readSession() takes: one pose or more, finite numbers, unit quaternions; it reads them back bit
// by bit. Throws InputError naming the file if it cannot be written.
void writeSession(const std::filesystem::path& path, const Session& session);

}  // namespace hlodbench
