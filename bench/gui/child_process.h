#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hlodbench {

// A program that runs beside this one; it ends with it.
class ChildProcess {
 public:
  // arguments: the program first, by its path. What it prints goes to the file `log`. Throws
  // InputError where it cannot be started.
  ChildProcess(const std::vector<std::string>& arguments, const std::filesystem::path& log);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  // Its exit code once it has ended, 128 + the signal's number if by a signal. Does not wait.
  std::optional<int> poll();

 private:
  pid_t id_ = -1;
  std::optional<int> code_;
};

}  // namespace hlodbench
