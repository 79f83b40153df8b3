#pragma once

#include <string>
#include <vector>

#include "hlod/scene/json_node.h"
#include "session.h"

namespace hlodbench {

// The parts of a session file, which are also those of a recording's journal.

// Everything but the poses, of an object that has no keys but a session's. Throws InputError.
Session readSessionHead(const JsonNode& root);

// The same as lines "KEY": VALUE in the file's order, without "frames".
std::vector<std::string> formatSessionHead(const Session& session);

// A frame's array of 7 numbers. Throws InputError. A quaternion of length 1 to the last digits
// stays as it is, so that what was written comes back bit by bit.
Pose readPose(const JsonNode& node);

// Of finite numbers, each with the fewest digits that give the same double again.
std::string formatPose(const Pose& pose);

}  // namespace hlodbench
