#pragma once

#include <deque>
#include <vector>

#include "metrics/counters.h"

namespace hlodbench {

// The counters of the last frames, a list for each pane.
class CounterHistory {
 public:
  static constexpr std::size_t kFrames = 240;

  // seconds: from the last frame to this one; records: one for each pane.
  void add(double seconds, const std::vector<FrameRecord>& records);
  void clear() { *this = CounterHistory(); }

  [[nodiscard]] std::size_t paneCount() const { return panes_.size(); }
  // Of the last second.
  [[nodiscard]] double framesPerSecond() const;
  // The mean of the frames that have it, oldest first where there are several; NaN where none has.
  [[nodiscard]] double mean(std::size_t pane, Counter counter) const;
  // A value a frame, oldest first; a counter that is absent is left out.
  [[nodiscard]] std::vector<float> values(std::size_t pane, Counter counter) const;

 private:
  std::deque<double> seconds_;
  std::vector<std::deque<FrameRecord>> panes_;
};

}  // namespace hlodbench
