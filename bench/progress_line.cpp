#include "progress_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace hlodbench {

ProgressLine::ProgressLine(std::string title)
    : title_(std::move(title)), terminal_(isatty(STDERR_FILENO) == 1), start_(Clock::now()) {}

ProgressLine::~ProgressLine() {
  if (terminal_ && width_ > 0) fmt::print(stderr, "\r{:{}}\r", "", width_);
}

void ProgressLine::update(const std::string& stage, double share) {
  const auto now = Clock::now();
  const auto pause = terminal_ ? std::chrono::milliseconds(100) : std::chrono::milliseconds(5000);
  if (shown_ != Clock::time_point() && now - shown_ < pause) return;
  shown_ = now;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  std::string text = fmt::format("{}: {:3.0f} % {}, {:.0f} s", title_,
                                 100.0 * std::clamp(share, 0.0, 1.0), stage, elapsed);
  // an estimate from less than this says nothing
  if (share > 0.02 && elapsed > 1.0)
    text += fmt::format(", about {:.0f} s left", elapsed * (1.0 - share) / share);
  if (terminal_) {
    width_ = std::max(width_, text.size());
    fmt::print(stderr, "\r{:{}}", text, width_);
  } else {
    fmt::print(stderr, "{}\n", text);
  }
  std::fflush(stderr);
}

}  // namespace hlodbench
