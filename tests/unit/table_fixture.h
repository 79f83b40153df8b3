#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "metrics/result_json.h"

namespace hlodbench {
struct TableValues {
  const char* strategy;
  const char* label;
  double dn;
  double rarn;
  double d;  // negative: the strategy has no such counter
  double fps;
};

// The paper's scene 1 as if it were measured.
inline constexpr TableValues kPaperScene1[] = {{"coh-b", "Coh(B)", 183.3, 0.1, 4.7, 191.6},
                                               {"bool", "Bool", 217.0, 0.0, -1.0, 169.9},
                                               {"sw-b", "SW(B)", 181.4, 0.0, -1.0, 47.3},
                                               {"simp-b", "Simp(B)", 200.0, 5.0, -1.0, 173.6}};

inline Summary makeSummary(const TableValues& values, double slowdown) {
  std::vector<FrameRecord> records(4);
  for (FrameRecord& record : records) {
    record.set(Counter::kDn, values.dn);
    record.set(Counter::kRarn, values.rarn);
    if (values.d >= 0.0) record.set(Counter::kD, values.d);
    record.set(Counter::kFrameMs, slowdown * 1000.0 / values.fps);
  }
  return computeSummary(records);
}

inline RunResult makeRun(const std::string& scene, int repetitions) {
  RunResult run;
  run.environment.program = "hlodbench 0.1.0";
  run.environment.buildType = "Release";
  run.scene = {scene, "00ff", 5012345, 12001, nlohmann::json::object()};
  run.session = {"walk", "ff00", 4};
  run.warmUpFrames = 10;
  run.repetitions = repetitions;
  std::vector<CaseKey> planned;
  for (int repetition = 0; repetition < repetitions; ++repetition)
    for (const TableValues& values : kPaperScene1) {
      CaseResult result;
      result.key = {values.strategy, repetition};
      result.label = values.label;
      result.csv = "x.csv";
      result.summary = makeSummary(values, 1.0 + repetition);
      planned.push_back(result.key);
      run.cases.push_back(std::move(result));
    }
  finishRun(run, planned);
  return run;
}

// Result folders that go away with the test.
class Table : public testing::Test {
 protected:
  Table()
      : root_(std::filesystem::temp_directory_path() /
              fmt::format("hlodbench-table-{}", ::getpid())) {
    std::filesystem::remove_all(root_);
    std::filesystem::create_directories(root_);
  }
  ~Table() override { std::filesystem::remove_all(root_); }

  std::filesystem::path write(const std::string& name, const RunResult& run) const {
    std::filesystem::create_directories(root_ / name);
    writeRunResult(root_ / name, run);
    return root_ / name;
  }

  std::filesystem::path root_;
};

}  // namespace hlodbench
