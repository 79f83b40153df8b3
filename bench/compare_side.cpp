#include "compare_side.h"

#include <fmt/format.h>

#include <algorithm>

#include "hlod/core/error.h"
#include "metrics/frame_csv.h"
#include "metrics/result_json.h"
#include "table_model.h"

namespace hlodbench {
namespace {

// A folder whose name has a colon in it is still a folder.
void splitArgument(CompareSide& side) {
  std::error_code ignored;
  const std::size_t colon = side.argument.rfind(':');
  if (colon == side.argument.npos || std::filesystem::is_directory(side.argument, ignored)) {
    side.folder = side.argument;
    return;
  }
  side.folder = side.argument.substr(0, colon);
  side.strategy = side.argument.substr(colon + 1);
  if (side.strategy.empty())
    throw InputError(side.argument + ": expected a strategy after the colon, found none");
}

void checkStrategy(const CompareSide& side) {
  std::string known;
  for (const CaseResult& c : side.run.cases) {
    if (side.strategy.empty() || c.key.strategy == side.strategy) return;
    if (known.find(c.key.strategy) == known.npos)
      known += (known.empty() ? "" : ", ") + c.key.strategy;
  }
  if (side.strategy.empty())
    throw InputError(side.folder.string() + ": expected a replay that ended, found none");
  throw InputError(fmt::format("{}: expected a strategy of the run ({}), found '{}'", side.argument,
                               known.empty() ? "it has none" : known, side.strategy));
}

std::vector<FrameRecord> readLog(const CompareSide& side, const CaseResult& c) {
  const std::filesystem::path path = side.folder / c.csv;
  std::vector<FrameRecord> records = readFrameCsv(path);
  if (records.size() != static_cast<std::size_t>(side.run.session.frames))
    throw InputError(fmt::format("{}: expected the session's {} frames, found {}", path.string(),
                                 side.run.session.frames, records.size()));
  for (std::size_t i = 0; i < records.size(); ++i)
    if (records[i].frame != static_cast<int>(i))
      throw InputError(fmt::format("{}:{}: expected frame {}, found {}", path.string(), i + 2, i,
                                   records[i].frame));
  return records;
}

}  // namespace

std::string CompareSide::label(const std::string& name) const {
  for (const CaseResult& c : run.cases)
    if (c.key.strategy == name) return tableLabel(name, c.label);
  return name;
}

const StrategyPictures* CompareSide::findPictures(const std::string& name) const {
  if (!images) return nullptr;
  for (const StrategyPictures& pictures : images->strategies)
    if (pictures.strategy == name) return &pictures;
  return nullptr;
}

CompareSide readCompareSide(const std::string& argument) {
  CompareSide side;
  side.argument = argument;
  splitArgument(side);
  side.run = readRunResult(side.folder);
  checkStrategy(side);
  for (const CaseResult& c : side.run.cases) {
    if (!side.strategy.empty() && c.key.strategy != side.strategy) continue;
    if (c.error || c.csv.empty()) continue;
    side.logs[c.key.strategy][c.key.repetition] = readLog(side, c);
  }
  side.images = readImageResult(side.folder);
  return side;
}

}  // namespace hlodbench
