#pragma once

#include <stdexcept>
#include <string>

namespace hlodbench {

// Bad input or wrong usage: the message is one line that names the file, the place in it, what was
// expected and what was found. Ends the program with exit code 2.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// No usable OpenGL context: the message lists what was tried, why it failed and which package is
// missing. Ends the program with exit code 3.
struct GlUnavailable : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Process exit codes; the same for every sub-command.
enum class ExitCode : int { kOk = 0, kCheckFailed = 1, kBadInput = 2, kNoGl = 3 };

}  // namespace hlodbench
