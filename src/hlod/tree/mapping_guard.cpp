#include "hlod/tree/mapping_guard.h"

#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <mutex>

#include "hlod/core/error.h"

namespace hlodbench {
namespace {

// What the signal handler reads. `message` is set last and cleared first: an entry without one is
// not there.
struct Guarded {
  std::atomic<std::uintptr_t> begin{0}, end{0};
  std::atomic<char*> message{nullptr};
};
static_assert(std::atomic<std::uintptr_t>::is_always_lock_free &&
              std::atomic<char*>::is_always_lock_free);

std::array<Guarded, 256> guarded;
std::mutex guardedMutex;
struct sigaction previousAction;

// Calls nothing but what is allowed in a signal handler.
void onBusError(int, siginfo_t* info, void*) {
  const auto address = reinterpret_cast<std::uintptr_t>(info->si_addr);
  // a positive code: from the system, not sent by a process
  for (const Guarded& entry : guarded) {
    const char* const message = entry.message.load();
    if (message == nullptr || info->si_code <= 0) continue;
    if (address < entry.begin || address >= entry.end) continue;
    // nothing can be done about a line that cannot be written
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, message, std::strlen(message));
    ::_exit(static_cast<int>(ExitCode::kBadInput));
  }
  // not ours: it happens again, now without us
  ::sigaction(SIGBUS, &previousAction, nullptr);
  if (info->si_code <= 0) ::raise(SIGBUS);
}

void installHandler() {
  struct sigaction action {};
  action.sa_sigaction = onBusError;
  action.sa_flags = SA_SIGINFO;
  sigemptyset(&action.sa_mask);
  ::sigaction(SIGBUS, &action, &previousAction);
}

}  // namespace

void guardMapping(std::span<const std::byte> bytes, const std::string& path) {
  static std::once_flag once;
  std::call_once(once, installHandler);
  const std::lock_guard lock(guardedMutex);
  for (Guarded& entry : guarded) {
    if (entry.message.load() != nullptr) continue;
    entry.begin = reinterpret_cast<std::uintptr_t>(bytes.data());
    entry.end = entry.begin + bytes.size();
    entry.message = ::strdup(("hlodbench: " + path + ": cut off while it was in use\n").c_str());
    return;
  }
}

void unguardMapping(std::span<const std::byte> bytes) {
  const std::lock_guard lock(guardedMutex);
  for (Guarded& entry : guarded)
    if (entry.message.load() != nullptr &&
        entry.begin == reinterpret_cast<std::uintptr_t>(bytes.data()))
      std::free(entry.message.exchange(nullptr));
}

}  // namespace hlodbench
