#include "metrics/result.h"

#include <algorithm>
#include <map>

namespace hlodbench {
namespace {

std::map<int, double> computeFpsByRepetition(const std::vector<CaseResult>& cases,
                                             const std::string& strategy) {
  std::map<int, double> fps;
  for (const CaseResult& result : cases)
    if (result.key.strategy == strategy && !result.error && result.summary && result.summary->fps)
      fps[result.key.repetition] = *result.summary->fps;
  return fps;
}

std::vector<std::string> computeStrategies(const std::vector<CaseResult>& cases) {
  std::vector<std::string> strategies;
  for (const CaseResult& result : cases)
    if (std::find(strategies.begin(), strategies.end(), result.key.strategy) == strategies.end())
      strategies.push_back(result.key.strategy);
  return strategies;
}

}  // namespace

std::optional<Speedup> computeSpeedup(const std::vector<CaseResult>& cases,
                                      const std::string& strategy, const std::string& over,
                                      const BootstrapOptions& options) {
  Speedup speedup{strategy, over, {}, {}};
  const std::map<int, double> reference = computeFpsByRepetition(cases, strategy);
  for (const auto& [repetition, fps] : computeFpsByRepetition(cases, over))
    if (const auto found = reference.find(repetition); found != reference.end())
      speedup.ratios.push_back(found->second / fps);
  if (speedup.ratios.empty()) return std::nullopt;
  speedup.interval = computeMedianInterval(speedup.ratios, options);
  return speedup;
}

std::vector<Speedup> computeSpeedups(const std::vector<CaseResult>& cases,
                                     const std::string& strategy, const BootstrapOptions& options) {
  std::vector<Speedup> speedups;
  for (const std::string& over : computeStrategies(cases)) {
    if (over == strategy) continue;
    if (auto speedup = computeSpeedup(cases, strategy, over, options))
      speedups.push_back(std::move(*speedup));
  }
  return speedups;
}

void finishRun(RunResult& run, const std::vector<CaseKey>& planned) {
  run.missing.clear();
  for (const CaseKey& key : planned) {
    const auto isKey = [&](const CaseResult& result) { return result.key == key; };
    if (std::none_of(run.cases.begin(), run.cases.end(), isKey)) run.missing.push_back(key);
  }
  run.complete = run.missing.empty();
  run.speedups = computeSpeedups(run.cases);
}

}  // namespace hlodbench
