#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "heartbeat.h"

namespace hlodbench {

// A replay that ended its process, or that had to be ended.
struct LostCase {
  int index;          // in the plan
  std::string error;  // one line: "ended by signal SIGSEGV in frame 12"
};

// What a process that works under a supervisor knows.
struct Watch {
  Heartbeat* heartbeat;
  bool isContinued = false;         // an earlier process did part of the work
  std::vector<LostCase> lost = {};  // that way
};

struct SupervisorOptions {
  double frameTimeout = 30.0;  // seconds that a frame may take; 0: any time
  std::vector<std::filesystem::path>
      plugins;  // for messages, in the order in which they are loaded
  // in which a worker that died may have left files of AtomicFile
  std::vector<std::filesystem::path> folders = {};
  std::vector<std::filesystem::path> temporary =
      {};  // files from worker to worker, removed at the end
};

// Leaves the work to a second process, so that a plug-in that crashes or never comes back costs one
// replay and not the run. The worker does all the work, in one process, as without a plug-in; the
// supervisor waits. When the worker ends by itself, or for a reason that is no plug-in's, so does
// the supervisor. When it dies within a replay, or a frame takes too long, the next worker goes on
// behind that replay.
//
// A worker is the program started anew with the same arguments, since libraries have threads that a
// fork alone would lose. To be called first of all. Returns nothing in a worker, with `watch`
// filled, and the exit code in the supervisor. Signals that ask for an end are passed on.
std::optional<int> supervise(Watch& watch, const std::vector<std::string>& arguments,
                             const SupervisorOptions& options);

}  // namespace hlodbench
