#pragma once

#include <chrono>
#include <string>

#include "hlod/core/progress.h"

namespace hlodbench {

// Progress on stderr: one line that is rewritten on a terminal, else a line every few seconds; with
// the time elapsed and an estimate of the time left.
class ProgressLine {
 public:
  explicit ProgressLine(std::string title);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  // share: 0 to 1 of the whole.
  void update(const std::string& stage, double share);
  // The same, as the function that long work takes; the line must outlive it.
  Progress asProgress() {
    return [this](const std::string& stage, double share) { update(stage, share); };
  }

 private:
  using Clock = std::chrono::steady_clock;
  std::string title_;
  bool terminal_;
  Clock::time_point start_;
  Clock::time_point shown_;
  std::size_t width_ = 0;  // of the line on the terminal
};

}  // namespace hlodbench
