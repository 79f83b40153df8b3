// The rows of counters: exact ones by frame, noisy ones over repetitions.

#include <fmt/format.h>

#include <algorithm>

#include "compare_rows.h"
#include "hlod/core/error.h"
#include "metrics/summary.h"

namespace hlodbench {
namespace {

constexpr std::string_view kTimeUnit = "ms";

// Frames of a log that enter a comparison: measured, and by the other side, too, where its frames
// are the same.
std::vector<int> listFrames(const ReplayLogs& logs, const ReplayLogs& others, bool sameSession) {
  std::vector<int> frames;
  const std::vector<FrameRecord>& log = logs.begin()->second;
  const std::vector<FrameRecord>& other = others.begin()->second;
  for (std::size_t i = 0; i < log.size(); ++i)
    if (!log[i].warmUp && (!sameSession || (i < other.size() && !other[i].warmUp)))
      frames.push_back(static_cast<int>(i));
  if (frames.empty()) throw InputError("compare: expected a frame measured in both, found none");
  return frames;
}

std::vector<double> listValues(const std::vector<FrameRecord>& log, const std::vector<int>& frames,
                               Counter counter) {
  std::vector<double> values;
  for (const int frame : frames)
    if (log[frame].has(counter)) values.push_back(log[frame].get(counter));
  return values;
}

double computeMedian(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return computeQuantile(values, 0.5);
}

// Whether every repetition has the same value in every frame, so that one stands for all.
bool isRepeated(const ReplayLogs& logs, Counter counter) {
  const std::vector<FrameRecord>& first = logs.begin()->second;
  return std::all_of(logs.begin(), logs.end(), [&](const auto& entry) {
    return std::equal(first.begin(), first.end(), entry.second.begin(), entry.second.end(),
                      [&](const FrameRecord& x, const FrameRecord& y) {
                        return x.has(counter) == y.has(counter) &&
                               (!x.has(counter) || x.get(counter) == y.get(counter));
                      });
  });
}

bool hasCounter(const ReplayLogs& logs, Counter counter) {
  for (const auto& [repetition, log] : logs)
    for (const FrameRecord& record : log)
      if (record.has(counter)) return true;
  return false;
}

CompareRow makeRow(const CounterInfo& info) {
  CompareRow row;
  row.group = info.unit == kTimeUnit ? "times" : "counts";
  row.key = info.key;
  row.label =
      std::string(info.counter == Counter::kFrameMs ? "median " : "") + std::string(info.label);
  row.unit = info.unit;
  return row;
}

// One value of each repetition; a repetition that does not have it is not there.
template <typename Value>
std::map<int, double> computeByRepetition(const ReplayLogs& logs, const Value& value) {
  std::map<int, double> values;
  for (const auto& [repetition, log] : logs)
    if (const std::optional<double> one = value(log)) values[repetition] = *one;
  return values;
}

// Frames over total time, 1/s.
std::optional<double> computeFps(const std::vector<FrameRecord>& log,
                                 const std::vector<int>& frames) {
  const std::vector<double> times = listValues(log, frames, Counter::kFrameMs);
  const double mean = times.empty() ? 0.0 : computeMean(times);
  return mean > 0.0 ? std::optional(1000.0 / mean) : std::nullopt;
}

// The median of frame_ms, as its mean is in the frame rate; the mean of the others: times of stages
// add up, and the median of what happens rarely is 0.
std::optional<double> computeMiddle(const std::vector<FrameRecord>& log,
                                    const std::vector<int>& frames, Counter counter) {
  const std::vector<double> values = listValues(log, frames, counter);
  if (values.empty()) return std::nullopt;
  return counter == Counter::kFrameMs ? computeMedian(values) : computeMean(values);
}

void judgeRepetitions(const std::map<int, double>& a, const std::map<int, double>& b,
                      const PairInput& input, Better better, CompareRow& row) {
  std::vector<double> valuesA, valuesB;
  for (const auto& [repetition, value] : a)
    if (!input.sameRun || b.count(repetition)) valuesA.push_back(value);
  for (const auto& [repetition, value] : b)
    if (!input.sameRun || a.count(repetition)) valuesB.push_back(value);
  if (valuesA.empty() || valuesB.empty()) {
    row.judgement.reason = "no repetition that both have";
    return;
  }
  const NoisyComparison comparison =
      compareNoisy(valuesA, valuesB, better, input.sameRun, input.verdict);
  row.basis = input.sameRun ? fmt::format("{} pairs", valuesA.size())
                            : fmt::format("{} and {} repetitions", valuesA.size(), valuesB.size());
  row.a = computeMedian(valuesA);
  row.b = computeMedian(valuesB);
  row.difference = comparison.change.absolute;
  row.relative = comparison.change.relative;
  row.p = comparison.test.p;
  row.a12 = comparison.test.a12;
  row.judgement = comparison.judgement;
}

class CounterRows {
 public:
  CounterRows(const PairInput& input, ComparePair& pair)
      : input_(input),
        pair_(pair),
        framesA_(listFrames(input.a, input.b, input.sameSession)),
        framesB_(listFrames(input.b, input.a, input.sameSession)) {}

  // The counter's row, if both have it.
  void add(const CounterInfo& info) {
    const bool ofA = hasCounter(input_.a, info.counter);
    const bool ofB = hasCounter(input_.b, info.counter);
    if (ofA != ofB)
      pair_.notes.push_back(fmt::format("{}: only {} has it", info.key, ofA ? "A" : "B"));
    if (!ofA || !ofB) return;
    CompareRow row = makeRow(info);
    if (isExact(info))
      addExact(info, row);
    else
      addNoisy(info, row);
    pair_.rows.push_back(std::move(row));
  }

  void addFps() {
    CompareRow row{"times", "fps", "FPS", "1/s"};
    const auto a =
        computeByRepetition(input_.a, [&](const auto& log) { return computeFps(log, framesA_); });
    const auto b =
        computeByRepetition(input_.b, [&](const auto& log) { return computeFps(log, framesB_); });
    if (a.empty() || b.empty()) return;
    judgeRepetitions(a, b, input_, Better::kHigher, row);
    pair_.rows.push_back(std::move(row));
  }

 private:
  bool isExact(const CounterInfo& info) {
    if (info.exactness != Exactness::kExact || !input_.exactCounts) return false;
    const bool repeatedA = isRepeated(input_.a, info.counter);
    if (repeatedA && isRepeated(input_.b, info.counter)) return true;
    pair_.notes.push_back(
        fmt::format("{}: the repetitions of {} count differently although the latency is fixed: "
                    "compared over repetitions",
                    info.key, repeatedA ? "B" : "A"));
    return false;
  }

  void addExact(const CounterInfo& info, CompareRow& row) {
    const std::vector<FrameRecord>& logA = input_.a.begin()->second;
    const std::vector<FrameRecord>& logB = input_.b.begin()->second;
    if (!input_.sameSession) {
      addExactMeans(info, row);
      return;
    }
    std::vector<double> a, b;
    std::vector<int> frames;
    for (const int frame : framesA_) {
      if (!logA[frame].has(info.counter) || !logB[frame].has(info.counter)) continue;
      frames.push_back(frame);
      a.push_back(logA[frame].get(info.counter));
      b.push_back(logB[frame].get(info.counter));
    }
    if (frames.empty())
      row.judgement.reason = "no frame that has it in both";
    else
      judgeFrames(a, b, frames, info.better, row);
  }

  // Of different sessions there are no frames to pair.
  void addExactMeans(const CounterInfo& info, CompareRow& row) {
    const std::vector<double> a = listValues(input_.a.begin()->second, framesA_, info.counter);
    const std::vector<double> b = listValues(input_.b.begin()->second, framesB_, info.counter);
    if (a.empty() || b.empty()) {
      row.judgement.reason = "no measured frame has it";
      return;
    }
    row.a = computeMean(a);
    row.b = computeMean(b);
    row.basis = fmt::format("{} and {} frames", a.size(), b.size());
    row.difference = Interval{*row.b - *row.a, {}, {}};
    if (*row.a > 0.0) row.relative = Interval{*row.b / *row.a - 1.0, {}, {}};
    const bool equal = *row.a == *row.b;
    row.judgement = {equal ? Verdict::kSame : computeDirection(*row.b - *row.a, info.better),
                     equal ? "equal means of other frames" : "means of other frames"};
  }

  void addNoisy(const CounterInfo& info, CompareRow& row) {
    const auto a = computeByRepetition(
        input_.a, [&](const auto& log) { return computeMiddle(log, framesA_, info.counter); });
    const auto b = computeByRepetition(
        input_.b, [&](const auto& log) { return computeMiddle(log, framesB_, info.counter); });
    judgeRepetitions(a, b, input_, info.better, row);
  }

  const PairInput& input_;
  ComparePair& pair_;
  std::vector<int> framesA_, framesB_;
};

void addRows(const PairInput& input, bool times, ComparePair& pair) {
  CounterRows rows(input, pair);
  if (times) rows.addFps();
  for (const CounterInfo& info : kCounterTable)
    if ((info.unit == kTimeUnit) == times) rows.add(info);
}

}  // namespace

void addCountRows(const PairInput& input, ComparePair& pair) {
  addRows(input, false, pair);
}

void addTimeRows(const PairInput& input, ComparePair& pair) {
  addRows(input, true, pair);
}

}  // namespace hlodbench
