#include "metrics/result_json.h"

#include "hlod/core/error.h"
#include "metrics/json_or_null.h"
#include "metrics/json_view.h"
#include "metrics/text_file.h"

namespace hlodbench {
namespace {

using Json = nlohmann::ordered_json;

Json toJson(const Environment& environment) {
  return {
      {"program", environment.program},
      {"git_revision", orNull(environment.gitRevision)},
      {"compiler", environment.compiler},
      {"build_type", environment.buildType},
      {"cpu_model", orNull(environment.cpuModel)},
      {"cpu_cores", environment.cpuCores},
      {"cpu_governor", orNull(environment.cpuGovernor)},
      {"distribution", orNull(environment.distribution)},
      {"kernel", environment.kernel},
      {"load_average", orNull(environment.loadAverage)},
      {"time_utc", environment.timeUtc},
      {"arguments", environment.arguments},
      {"gl",
       {{"vendor", environment.gl.vendor},
        {"renderer", environment.gl.renderer},
        {"version", environment.gl.version}}},
  };
}

Json toJson(const CounterSummary& counter) {
  return {
      {"count", counter.count}, {"mean", counter.mean}, {"median", counter.median},
      {"min", counter.min},     {"max", counter.max},   {"q1", counter.q1},
      {"q3", counter.q3},       {"p99", counter.p99},   {"stddev", counter.stddev},
  };
}

Json toJson(const Summary& summary) {
  Json counters = Json::object();
  for (const CounterInfo& info : kCounterTable)
    if (const auto& counter = summary.get(info.counter))
      counters[std::string(info.key)] = toJson(*counter);
  return {
      {"frames", summary.frames},
      {"warm_up_frames", summary.warmUpFrames},
      {"fps", orNull(summary.fps)},
      {"fps_frame_mean", orNull(summary.fpsFrameMean)},
      {"delayed_share", orNull(summary.delayedShare)},
      {"counters", std::move(counters)},
  };
}

Json toJson(const CaseKey& key) {
  return {{"strategy", key.strategy}, {"repetition", key.repetition}};
}

Json toJson(const CaseResult& result) {
  return {
      {"strategy", result.key.strategy},
      {"label", result.label},
      {"repetition", result.key.repetition},
      {"order", result.order},
      {"csv", result.csv.empty() ? Json(nullptr) : Json(result.csv)},
      {"error", orNull(result.error)},
      {"summary", result.summary ? toJson(*result.summary) : Json(nullptr)},
  };
}

Json toJson(const Speedup& speedup) {
  return {
      {"strategy", speedup.strategy},
      {"over", speedup.over},
      {"ratios", speedup.ratios},
      {"median", speedup.interval.median},
      {"low", orNull(speedup.interval.low)},
      {"high", orNull(speedup.interval.high)},
  };
}

template <typename T>
Json toJsonArray(const std::vector<T>& items) {
  Json array = Json::array();
  for (const T& item : items) array.push_back(toJson(item));
  return array;
}

}  // namespace

nlohmann::ordered_json toJson(const RunResult& run) {
  Json context = toJson(run.environment);
  context["warnings"] = run.warnings;
  return {
      {"schema_version", kResultSchemaVersion},
      {"context", std::move(context)},
      {"scene",
       {{"name", run.scene.name},
        {"hash", run.scene.hash},
        {"triangles", run.scene.triangles},
        {"nodes", run.scene.nodes},
        {"build", Json(run.scene.build)}}},
      {"session",
       {{"name", run.session.name}, {"hash", run.session.hash}, {"frames", run.session.frames}}},
      {"options", Json(run.options)},
      {"frames_in_flight", run.framesInFlight},
      {"warm_up_frames", run.warmUpFrames},
      {"repetitions", run.repetitions},
      {"complete", run.complete},
      {"missing", toJsonArray(run.missing)},
      {"speedups", toJsonArray(run.speedups)},
      {"cases", toJsonArray(run.cases)},
  };
}

void writeRunResult(const std::filesystem::path& folder, const RunResult& run) {
  writeTextFile(folder / kResultFileName,
                toJson(run).dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

RunResult readRunResult(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / kResultFileName;
  if (!std::filesystem::exists(path))
    throw InputError(folder.string() + ": expected a result folder with a " + kResultFileName +
                     " in it, found none");
  return runResultFromJson(parseJson(readTextFile(path), path.string()), path.string());
}

}  // namespace hlodbench
