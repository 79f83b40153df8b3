// The reading half of result_json.h: each function takes the JSON object it is named after.

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "metrics/json_view.h"
#include "metrics/result_json.h"

namespace hlodbench {
namespace {

constexpr std::int64_t kMaxInt = std::numeric_limits<int>::max();

int readInt(const JsonView& view) {
  return static_cast<int>(view.integer(0, kMaxInt));
}

std::uint64_t readCount(const JsonView& view) {
  return static_cast<std::uint64_t>(view.integer());
}

std::optional<std::string> readText(const std::optional<JsonView>& view) {
  return view ? std::optional(view->text()) : std::nullopt;
}

std::optional<double> readNumber(const std::optional<JsonView>& view) {
  return view ? std::optional(view->number()) : std::nullopt;
}

std::vector<std::string> readTexts(const JsonView& view) {
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < view.size(); ++i) texts.push_back(view.item(i).text());
  return texts;
}

void checkVersion(const JsonView& view) {
  const std::string expected = kResultSchemaVersion;
  const std::string major = expected.substr(0, expected.find('.') + 1);
  if (view.text().substr(0, major.size()) != major)
    view.fail(fmt::format("a version {}x (this program writes {})", major, expected), view.text());
}

Environment readContext(const JsonView& view) {
  Environment environment;
  environment.program = view.at("program").text();
  environment.gitRevision = readText(view.find("git_revision"));
  environment.compiler = view.at("compiler").text();
  environment.buildType = view.at("build_type").text();
  environment.cpuModel = readText(view.find("cpu_model"));
  environment.cpuCores = readInt(view.at("cpu_cores"));
  environment.cpuGovernor = readText(view.find("cpu_governor"));
  environment.distribution = readText(view.find("distribution"));
  environment.kernel = view.at("kernel").text();
  if (const auto load = view.find("load_average")) {
    if (load->size() != 3) load->fail("3 numbers", fmt::format("{}", load->size()));
    environment.loadAverage = {load->item(0).number(), load->item(1).number(),
                               load->item(2).number()};
  }
  environment.timeUtc = view.at("time_utc").text();
  environment.arguments = readTexts(view.at("arguments"));
  const JsonView gl = view.at("gl");
  environment.gl = {gl.at("vendor").text(), gl.at("renderer").text(), gl.at("version").text()};
  return environment;
}

SceneInfo readScene(const JsonView& view) {
  return {view.at("name").text(), view.at("hash").text(), readCount(view.at("triangles")),
          readCount(view.at("nodes")), view.at("build").object()};
}

SessionInfo readSession(const JsonView& view) {
  return {view.at("name").text(), view.at("hash").text(), readInt(view.at("frames"))};
}

CounterSummary readCounter(const JsonView& view) {
  CounterSummary counter;
  counter.count = static_cast<std::size_t>(view.at("count").integer(1));
  counter.mean = view.at("mean").number();
  counter.median = view.at("median").number();
  counter.min = view.at("min").number();
  counter.max = view.at("max").number();
  counter.q1 = view.at("q1").number();
  counter.q3 = view.at("q3").number();
  counter.p99 = view.at("p99").number();
  counter.stddev = view.at("stddev").number();
  return counter;
}

std::optional<double> readRate(const std::optional<JsonView>& view) {
  const std::optional<double> rate = readNumber(view);
  if (rate && !(*rate > 0.0)) view->fail("a number above 0", fmt::format("{}", *rate));
  return rate;
}

Summary readSummary(const JsonView& view) {
  Summary summary;
  summary.frames = readCount(view.at("frames"));
  summary.warmUpFrames = readCount(view.at("warm_up_frames"));
  summary.fps = readRate(view.find("fps"));
  summary.fpsFrameMean = readRate(view.find("fps_frame_mean"));
  summary.delayedShare = readNumber(view.find("delayed_share"));
  const JsonView counters = view.at("counters");
  for (std::size_t i = 0; i < kCounterCount; ++i)
    if (const auto counter = counters.find(kCounterTable[i].key))
      summary.counters[i] = readCounter(*counter);
  return summary;
}

CaseKey readKey(const JsonView& view) {
  return {view.at("strategy").text(), readInt(view.at("repetition"))};
}

CaseResult readCase(const JsonView& view) {
  CaseResult result;
  result.key = readKey(view);
  result.label = view.at("label").text();
  result.order = readInt(view.at("order"));
  result.error = readText(view.find("error"));
  if (const auto summary = view.find("summary")) result.summary = readSummary(*summary);
  if (!result.error && !result.summary) view.fail("a summary or an error", "neither");
  if (const auto csv = view.find("csv")) {
    result.csv = csv->text();
    const std::filesystem::path path(result.csv);
    if (path.is_absolute() || std::find(path.begin(), path.end(), "..") != path.end())
      csv->fail("a name inside the result folder", fmt::format("\"{}\"", result.csv));
  }
  return result;
}

void checkUnique(const JsonView& view, const std::vector<CaseResult>& cases) {
  for (std::size_t i = 0; i < cases.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (cases[i].key == cases[j].key)
        view.item(i).fail(
            "each strategy and repetition once",
            fmt::format("{} repetition {} again", cases[i].key.strategy, cases[i].key.repetition));
}

Speedup readSpeedup(const JsonView& view) {
  Speedup speedup{view.at("strategy").text(), view.at("over").text(), {}, {}};
  const JsonView ratios = view.at("ratios");
  for (std::size_t i = 0; i < ratios.size(); ++i) speedup.ratios.push_back(ratios.item(i).number());
  speedup.interval = {view.at("median").number(), readNumber(view.find("low")),
                      readNumber(view.find("high"))};
  return speedup;
}

template <typename T>
std::vector<T> readArray(const JsonView& view, T (*readItem)(const JsonView&)) {
  std::vector<T> items;
  for (std::size_t i = 0; i < view.size(); ++i) items.push_back(readItem(view.item(i)));
  return items;
}

}  // namespace

RunResult runResultFromJson(const nlohmann::json& json, const std::string& name) {
  const JsonView view(json, name);
  checkVersion(view.at("schema_version"));
  RunResult run;
  run.environment = readContext(view.at("context"));
  run.warnings = readTexts(view.at("context").at("warnings"));
  run.scene = readScene(view.at("scene"));
  run.session = readSession(view.at("session"));
  run.options = view.at("options").object();
  run.framesInFlight = readInt(view.at("frames_in_flight"));
  run.warmUpFrames = readInt(view.at("warm_up_frames"));
  run.repetitions = readInt(view.at("repetitions"));
  run.complete = view.at("complete").boolean();
  run.missing = readArray(view.at("missing"), readKey);
  run.speedups = readArray(view.at("speedups"), readSpeedup);
  run.cases = readArray(view.at("cases"), readCase);
  checkUnique(view.at("cases"), run.cases);
  return run;
}

}  // namespace hlodbench
