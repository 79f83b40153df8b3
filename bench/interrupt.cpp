#include "interrupt.h"

#include <csignal>

namespace hlodbench {
namespace {

volatile std::sig_atomic_t interrupted = 0;

void onSignal(int signal) {
  interrupted = 1;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void catchInterrupts() {
  std::signal(SIGINT, onSignal);
  std::signal(SIGTERM, onSignal);
}

bool isInterrupted() {
  return interrupted != 0;
}

}  // namespace hlodbench
