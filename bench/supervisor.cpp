#include "supervisor.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <ctime>
#include <new>
#include <stdexcept>

#include "hlod/core/error.h"

namespace hlodbench {
namespace {

using Stage = Heartbeat::Stage;

constexpr double kLongestPause = 0.25;  // seconds between two looks at the heartbeat

Heartbeat* makeSharedHeartbeat() {
  void* const memory =
      mmap(nullptr, sizeof(Heartbeat), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED)
    throw std::runtime_error(fmt::format("no shared memory: {}", std::strerror(errno)));
  return new (memory) Heartbeat;
}

std::string nameSignal(int signal) {
#if defined(__GLIBC__) && (__GLIBC__ > 2 || __GLIBC_MINOR__ >= 32)
  if (const char* name = sigabbrev_np(signal)) return fmt::format("SIG{}", name);
#endif
  return fmt::format("{} ({})", signal, strsignal(signal));
}

// Ends this process by the signal, as it would have ended without a supervisor.
[[noreturn]] void endBySignal(int signal) {
  const rlimit noCore{0, 0};
  setrlimit(RLIMIT_CORE, &noCore);
  std::signal(signal, SIG_DFL);
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, signal);
  sigprocmask(SIG_UNBLOCK, &set, nullptr);
  raise(signal);
  _exit(128 + signal);
}

// One worker's end.
struct Ending {
  int status = 0;  // as of waitpid()
  bool tookTooLong = false;
  int request = 0;  // a signal that asked the supervisor for an end
};

class Supervisor {
 public:
  Supervisor(Watch& watch, const SupervisorOptions& options) : watch_(watch), options_(options) {
    sigemptyset(&signals_);
    for (const int signal : {SIGCHLD, SIGINT, SIGTERM, SIGTSTP}) sigaddset(&signals_, signal);
    sigprocmask(SIG_BLOCK, &signals_, &before_);
    watch_.heartbeat = makeSharedHeartbeat();
  }

  // As supervise().
  std::optional<int> run() {
    for (;;) {
      const pid_t supervisor = getpid();
      new (watch_.heartbeat) Heartbeat;
      worker_ = fork();
      if (worker_ < 0)
        throw std::runtime_error(fmt::format("no new process: {}", std::strerror(errno)));
      if (worker_ == 0) {
        beWorker(supervisor);
        return std::nullopt;
      }
      setpgid(worker_, worker_);  // whoever comes first
      const Ending ending = await();
      removeWhatAWorkerLeft();
      if (const std::optional<int> code = judge(ending)) {
        removeTemporary();
        return code;
      }
      watch_.isContinued = true;
    }
  }

 private:
  struct Place {
    Stage stage;
    int index, frame;
    bool operator==(const Place&) const = default;
  };

  void beWorker(pid_t supervisor) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != supervisor) _exit(1);
    // a group of its own: Ctrl-C goes to the supervisor, which passes it on once
    setpgid(0, 0);
    std::signal(SIGTTOU, SIG_IGN);
    sigprocmask(SIG_SETMASK, &before_, nullptr);
  }

  Ending await() {
    using Clock = std::chrono::steady_clock;
    Ending ending;
    const double timeout = options_.frameTimeout;
    const double pause = timeout > 0.0 ? std::min(kLongestPause, timeout / 4) : kLongestPause;
    const timespec wait{0, static_cast<long>(1e9 * pause)};
    Place place = readPlace();
    double waited = 0.0;
    auto last = Clock::now();
    while (waitpid(worker_, &ending.status, WNOHANG) == 0) {
      pass(sigtimedwait(&signals_, nullptr, &wait), ending);
      const auto now = Clock::now();
      // if it was longer, this process was stopped, and the worker probably too
      waited += std::min(std::chrono::duration<double>(now - last).count(), 2.0 * pause);
      last = now;
      if (const Place next = readPlace(); next != place) {
        place = next;
        waited = 0.0;
      }
      if (timeout > 0.0 && waited > timeout && place.stage != Stage::kOther) {
        ending.tookTooLong = true;
        kill(-worker_, SIGKILL);
        waitpid(worker_, &ending.status, 0);
        break;
      }
    }
    return ending;
  }

  void pass(int signal, Ending& ending) {
    if (signal == SIGINT || signal == SIGTERM) {
      ending.request = signal;
      kill(worker_, signal);
    } else if (signal == SIGTSTP) {
      kill(-worker_, SIGSTOP);
      raise(SIGSTOP);
      kill(-worker_, SIGCONT);
    }
  }

  // The exit code, or nothing when the next worker has to go on.
  std::optional<int> judge(const Ending& ending) {
    const Place place = readPlace();
    const bool hasExited = WIFEXITED(ending.status);
    const auto endAsWorker = [&]() -> int {
      if (hasExited) return WEXITSTATUS(ending.status);
      removeTemporary();
      endBySignal(WTERMSIG(ending.status));
    };
    if (place.stage == Stage::kLeaving && !hasExited) return watch_.heartbeat->exitCode;
    if (place.stage == Stage::kLeaving || place.stage == Stage::kOther) return endAsWorker();
    if (ending.request != 0 && !ending.tookTooLong) return endAsWorker();
    if (place.stage == Stage::kLoading) {
      fmt::print(stderr, "hlodbench: --plugin {}: {} while it was loaded\n",
                 options_.plugins.at(place.index).string(), describe(ending));
      return static_cast<int>(ExitCode::kBadInput);
    }
    watch_.lost.push_back({place.index, describeReplay(ending, place.frame)});
    if (ending.request == 0) return std::nullopt;
    fmt::print(stderr, "hlodbench: interrupted; {}\n", watch_.lost.back().error);
    return static_cast<int>(ExitCode::kCheckFailed);
  }

  [[nodiscard]] std::string describe(const Ending& ending) const {
    if (ending.tookTooLong) return fmt::format("did not end within {:g} s", options_.frameTimeout);
    if (WIFEXITED(ending.status))
      return fmt::format("ended the program by exit({})", WEXITSTATUS(ending.status));
    return "ended by signal " + nameSignal(WTERMSIG(ending.status));
  }

  [[nodiscard]] std::string describeReplay(const Ending& ending, int frame) const {
    if (frame == Heartbeat::kMaking) return describe(ending) + " while the strategy was made";
    if (frame == Heartbeat::kRemoving) return describe(ending) + " while the strategy was removed";
    if (ending.tookTooLong) return fmt::format("frame {} {}", frame, describe(ending));
    return fmt::format("{} in frame {}", describe(ending), frame);
  }

  [[nodiscard]] Place readPlace() const {
    const Heartbeat& at = *watch_.heartbeat;
    return {at.stage, at.index, at.frame};
  }

  // The number of the process is in the names of its temporary files.
  void removeWhatAWorkerLeft() const {
    const std::string end = fmt::format(".{}.tmp", worker_);
    std::error_code ignored;
    for (const std::filesystem::path& folder : options_.folders) {
      std::vector<std::filesystem::path> left;
      for (const auto& entry : std::filesystem::directory_iterator(folder, ignored))
        if (entry.path().string().ends_with(end)) left.push_back(entry.path());
      for (const auto& path : left) std::filesystem::remove(path, ignored);
    }
  }

  void removeTemporary() const {
    std::error_code ignored;
    for (const std::filesystem::path& file : options_.temporary)
      std::filesystem::remove(file, ignored);
  }

  Watch& watch_;
  const SupervisorOptions& options_;
  sigset_t signals_{}, before_{};
  pid_t worker_ = -1;
};

}  // namespace

std::optional<int> supervise(Watch& watch, const SupervisorOptions& options) {
  return Supervisor(watch, options).run();
}

}  // namespace hlodbench
