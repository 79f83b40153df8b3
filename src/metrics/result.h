#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "metrics/bootstrap.h"
#include "metrics/environment.h"
#include "metrics/summary.h"

namespace hlodbench {

// Version of run.json and of results/result.schema.json. Major: readers of the old one cannot read
// the new one. Minor: something was added that they may ignore.
inline constexpr const char* kResultSchemaVersion = "1.0.0";

// The file in a result folder that says what the folder holds; CSV names in it are relative to it.
inline constexpr const char* kResultFileName = "run.json";

struct SceneInfo {
  std::string name;
  std::string hash;             // of the hierarchy, hexadecimal; runs with other hashes differ
  std::uint64_t triangles = 0;  // full resolution
  std::uint64_t nodes = 0;      // of the hierarchy
  nlohmann::json build = nlohmann::json::object();  // how the hierarchy was built; free form

  bool operator==(const SceneInfo&) const = default;
};

struct SessionInfo {
  std::string name;
  std::string hash;  // of the session file, hexadecimal
  int frames = 0;    // poses in the session

  bool operator==(const SessionInfo&) const = default;
};

// One replay that was planned: what is missing after an interruption is named by it.
struct CaseKey {
  std::string strategy;  // id in the registry: "coh-b"
  int repetition = 0;    // from 0

  bool operator==(const CaseKey&) const = default;
};

// One replay of the session by one strategy: either a summary and its CSV, or an error.
struct CaseResult {
  CaseKey key;
  std::string label;  // for tables: "Coh(B)"
  int order = 0;      // position in the interleaving of all cases, from 0
  std::string csv;    // frame log, relative to the result folder; empty if the case failed
  std::optional<std::string> error;  // why the case failed, one line
  std::optional<Summary> summary;

  bool operator==(const CaseResult&) const = default;
};

// How much faster `strategy` is than `over`: the median over repetitions of the ratio of their FPS
// (frames over total time) within the same repetition, and its bootstrap interval.
struct Speedup {
  std::string strategy;
  std::string over;
  std::vector<double> ratios;  // by repetition, where both strategies have one
  MedianInterval interval;

  bool operator==(const Speedup&) const = default;
};

// Everything a run leaves but the per-frame CSV files.
struct RunResult {
  Environment environment;
  std::vector<std::string> warnings;
  SceneInfo scene;
  SessionInfo session;
  nlohmann::json options = nlohmann::json::object();  // the effective options of the run; free form
  int framesInFlight = 0;  // frames the processor may run ahead of the GPU; 0 finishes each
  int warmUpFrames = 0;    // replayed before the measured frames of every case
  int repetitions = 0;     // planned for every strategy
  std::vector<CaseResult> cases;
  std::vector<CaseKey> missing;  // planned and not begun or not finished
  bool complete = false;         // nothing is missing; failed cases are not missing
  std::vector<Speedup> speedups;

  bool operator==(const RunResult&) const = default;
};

// The strategy whose speedup over the others a run states (paper, Table 1).
inline constexpr const char* kReferenceStrategy = "coh-b";

// The strategy whose frame rate is the limit: each other one's is also stated as a share of it.
inline constexpr const char* kLimitStrategy = "oracle";

// Of `strategy` over `over`; absent without a repetition in which both have a frame rate.
std::optional<Speedup> computeSpeedup(const std::vector<CaseResult>& cases,
                                      const std::string& strategy, const std::string& over,
                                      const BootstrapOptions& options = {});

// Speedup of `strategy` over every other one, in the order in which these first appear. Cases that
// failed or have no frame time take no part; a pair without a common repetition is left out.
std::vector<Speedup> computeSpeedups(const std::vector<CaseResult>& cases,
                                     const std::string& strategy = kReferenceStrategy,
                                     const BootstrapOptions& options = {});

// Fills what follows from the cases: missing and complete (against `planned`), and the speedups.
// To be called before writing, after an interruption too.
void finishRun(RunResult& run, const std::vector<CaseKey>& planned);

}  // namespace hlodbench
