#include "view/counter_history.h"

namespace hlodbench {

void CounterHistory::add(double seconds, const std::vector<FrameRecord>& records) {
  if (records.size() != panes_.size()) panes_.assign(records.size(), {});
  seconds_.push_back(seconds);
  if (seconds_.size() > kFrames) seconds_.pop_front();
  for (std::size_t i = 0; i < records.size(); ++i) {
    panes_[i].push_back(records[i]);
    if (panes_[i].size() > kFrames) panes_[i].pop_front();
  }
}

double CounterHistory::framesPerSecond() const {
  double sum = 0.0;
  int frames = 0;
  for (auto seconds = seconds_.rbegin(); seconds != seconds_.rend() && sum < 1.0; ++seconds) {
    sum += *seconds;
    ++frames;
  }
  return sum > 0.0 ? frames / sum : 0.0;
}

double CounterHistory::mean(std::size_t pane, Counter counter) const {
  double sum = 0.0;
  int frames = 0;
  for (const FrameRecord& record : panes_[pane])
    if (record.has(counter)) {
      sum += record.get(counter);
      ++frames;
    }
  return sum / frames;
}

std::vector<float> CounterHistory::values(std::size_t pane, Counter counter) const {
  std::vector<float> values;
  for (const FrameRecord& record : panes_[pane])
    if (record.has(counter)) values.push_back(static_cast<float>(record.get(counter)));
  return values;
}

}  // namespace hlodbench
