#include "supervisor.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <stdexcept>

#include "hlod/core/error.h"

namespace hlodbench {
namespace {

using Stage = Heartbeat::Stage;

constexpr double kLongestPause = 0.25;  // seconds between two looks at the heartbeat

constexpr const char* kVariable = "HLODBENCH_WATCH";  // the descriptor of the shared memory
constexpr int kMostLost = 256;                        // at most one a strategy

// What the two processes share.
struct Shared {
  Heartbeat heartbeat;
  // written by the supervisor before a worker starts
  bool isContinued = false;
  int lostCount = 0;
  struct {
    int index;
    char error[256];
  } lost[kMostLost] = {};
};

[[noreturn]] void fail(const char* what) {
  throw std::runtime_error(fmt::format("{}: {}", what, std::strerror(errno)));
}

Shared* mapShared(int fd) {
  void* const memory = mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
  if (memory == MAP_FAILED) fail("no shared memory");
  return static_cast<Shared*>(memory);
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

// Signals of this process, kept by a handler: which thread gets them is not known.
std::atomic<int> requested{0};  // SIGINT or SIGTERM
std::atomic<bool> isToStop{false};
int wakeUp[2] = {-1, -1};  // a pipe

void onSignal(int signal) {
  const int error = errno;
  if (signal == SIGINT || signal == SIGTERM) requested = signal;
  if (signal == SIGTSTP) isToStop = true;
  [[maybe_unused]] const ssize_t written = write(wakeUp[1], "", 1);
  errno = error;
}

class Supervisor {
 public:
  Supervisor(Watch& watch, const std::vector<std::string>& arguments,
             const SupervisorOptions& options)
      : watch_(watch), options_(options) {
    fd_ = memfd_create("hlodbench", 0);
    if (fd_ < 0 || ftruncate(fd_, sizeof(Shared)) != 0) fail("no shared memory");
    shared_ = new (mapShared(fd_)) Shared;
    watch_.heartbeat = &shared_->heartbeat;
    if (pipe2(wakeUp, O_CLOEXEC | O_NONBLOCK) != 0) fail("no pipe");
    setenv(kVariable, std::to_string(fd_).c_str(), 1);
    for (const std::string& argument : arguments)
      argv_.push_back(const_cast<char*>(argument.c_str()));
    argv_.push_back(nullptr);
    struct sigaction action {};
    action.sa_handler = onSignal;
    action.sa_flags = SA_RESTART;
    for (const int signal : {SIGCHLD, SIGINT, SIGTERM, SIGTSTP})
      sigaction(signal, &action, nullptr);
  }

  int run() {
    for (;;) {
      startWorker();
      const Ending ending = await();
      removeWhatAWorkerLeft();
      if (const std::optional<int> code = judge(ending)) {
        removeTemporary();
        return *code;
      }
    }
  }

 private:
  struct Place {
    Stage stage;
    int index, frame;
    bool operator==(const Place&) const = default;
  };

  void startWorker() {
    new (&shared_->heartbeat) Heartbeat;
    const pid_t supervisor = getpid();
    worker_ = fork();
    if (worker_ < 0) fail("no new process");
    if (worker_ == 0) {
      // only what is allowed after a fork of several threads
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      if (getppid() != supervisor) _exit(1);
      // a group of its own: Ctrl-C goes to the supervisor, which passes it on once
      setpgid(0, 0);
      std::signal(SIGTTOU, SIG_IGN);
      execv("/proc/self/exe", argv_.data());
      _exit(127);
    }
    setpgid(worker_, worker_);  // whoever comes first
  }

  Ending await() {
    using Clock = std::chrono::steady_clock;
    Ending ending;
    const double timeout = options_.frameTimeout;
    const double pause = timeout > 0.0 ? std::min(kLongestPause, timeout / 4) : kLongestPause;
    Place place = readPlace();
    double waited = 0.0;
    auto last = Clock::now();
    while (waitpid(worker_, &ending.status, WNOHANG) == 0) {
      pollfd event{wakeUp[0], POLLIN, 0};
      poll(&event, 1, std::max(1, static_cast<int>(1e3 * pause)));
      passSignals(ending);
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

  void passSignals(Ending& ending) {
    char bytes[64];
    while (read(wakeUp[0], bytes, sizeof bytes) > 0) {
    }
    if (const int signal = requested.exchange(0); signal != 0) {
      ending.request = signal;
      kill(worker_, signal);
    }
    if (isToStop.exchange(false)) {
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
    const std::string error = describeReplay(ending, place.frame);
    if (ending.request != 0 || shared_->lostCount == kMostLost) {
      fmt::print(stderr, "hlodbench: interrupted; {}\n", error);
      return static_cast<int>(ExitCode::kCheckFailed);
    }
    auto& lost = shared_->lost[shared_->lostCount++];
    lost.index = place.index;
    std::snprintf(lost.error, sizeof lost.error, "%s", error.c_str());
    shared_->isContinued = true;
    return std::nullopt;
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
  int fd_ = -1;
  Shared* shared_ = nullptr;
  std::vector<char*> argv_;
  pid_t worker_ = -1;
};

}  // namespace

std::optional<int> supervise(Watch& watch, const std::vector<std::string>& arguments,
                             const SupervisorOptions& options) {
  const char* const descriptor = std::getenv(kVariable);
  if (descriptor == nullptr) return Supervisor(watch, arguments, options).run();
  const int fd = std::atoi(descriptor);
  Shared* const shared = mapShared(fd);
  close(fd);
  unsetenv(kVariable);
  watch.heartbeat = &shared->heartbeat;
  watch.isContinued = shared->isContinued;
  for (int i = 0; i < shared->lostCount; ++i)
    watch.lost.push_back({shared->lost[i].index, shared->lost[i].error});
  return std::nullopt;
}

}  // namespace hlodbench
