#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "metrics/image_result.h"
#include "metrics/result.h"

namespace hlodbench {

// The frame logs of one strategy, by repetition; those of failed cases are not there. Frame i of
// the session is record i.
using ReplayLogs = std::map<int, std::vector<FrameRecord>>;

// One side of a comparison: a result folder, or one strategy in it.
struct CompareSide {
  std::string argument;  // as the user wrote it
  std::filesystem::path folder;
  std::string strategy;  // empty: all
  RunResult run;
  std::map<std::string, ReplayLogs> logs;  // by strategy, of those asked for
  std::optional<ImageResult> images;

  // What tables call a strategy of this run.
  [[nodiscard]] std::string label(const std::string& name) const;
  // The pictures of a strategy, or null.
  [[nodiscard]] const StrategyPictures* findPictures(const std::string& name) const;
};

// Reads FOLDER or FOLDER:STRATEGY. Throws InputError for what cannot be read, a strategy that the
// run does not have, and a frame log that has not every frame of the session in order.
CompareSide readCompareSide(const std::string& argument);

}  // namespace hlodbench
