#include "turns.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>

#include <cerrno>

#include "hlod/core/error.h"

namespace hlodbench {
namespace {

constexpr char kTurn = 't';
constexpr int kLookEveryMs = 200;  // whether it was interrupted just before it began to wait

}  // namespace

Turns::Turns(int descriptor, int frames) : descriptor_(descriptor), frames_(frames) {
  struct stat status {};
  if (fstat(descriptor, &status) != 0 || !S_ISSOCK(status.st_mode))
    throw InputError(fmt::format(
        "--turns: expected the descriptor of an inherited socket, found {}", descriptor));
}

void Turns::take(const std::function<bool()>& isInterrupted) {
  pollfd waiting{descriptor_, POLLIN, 0};
  int ready = 0;
  while (ready <= 0 && !isInterrupted()) ready = poll(&waiting, 1, kLookEveryMs);
  char byte = 0;
  if (ready > 0) (void)recv(descriptor_, &byte, 1, MSG_DONTWAIT);
}

void Turns::pass() {
  // if the other program is gone, nobody waits
  while (send(descriptor_, &kTurn, 1, MSG_NOSIGNAL) < 0 && errno == EINTR) {
  }
}

}  // namespace hlodbench
