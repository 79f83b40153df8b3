#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <functional>

#include "hlod/core/error.h"
#include "metrics/frame_csv.h"
#include "metrics/paper_table.h"
#include "metrics/result_json.h"
#include "metrics/text_file.h"

namespace hlodbench {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;

std::vector<FrameRecord> makeFrames(double dn, double frameMs, bool delays) {
  std::vector<FrameRecord> records;
  for (int frame = 0; frame < 5; ++frame) {
    FrameRecord record;
    record.frame = frame == 0 ? 0 : frame - 1;
    record.warmUp = frame == 0;
    record.set(Counter::kDn, dn + frame % 2);
    record.set(Counter::kTriangles, 2000.0 * dn);
    record.set(Counter::kQueries, dn / 2.0);
    record.set(Counter::kFrameMs, frameMs + 0.25 * (frame % 2));
    if (delays) {
      record.set(Counter::kRarn, frame == 3 ? 1.0 : 0.0);
      record.set(Counter::kD, 4.0);
    }
    records.push_back(record);
  }
  return records;
}

CaseResult makeCase(const std::string& strategy, const std::string& label, int repetition,
                    int order) {
  CaseResult result;
  result.key = {strategy, repetition};
  result.label = label;
  result.order = order;
  result.csv = fmt::format("{}-{}.csv", strategy, repetition);
  const bool coherent = strategy == "coh-b";
  result.summary = computeSummary(
      makeFrames(coherent ? 184.0 : 216.0, (coherent ? 5.0 : 6.0) + repetition, coherent));
  return result;
}

// A run that was interrupted after one case had failed: it shows every part of the format.
RunResult makeExample() {
  RunResult run;
  run.environment.program = "hlodbench 0.1.0";
  run.environment.gitRevision = "0123456789ab";
  run.environment.compiler = "GCC 12.2.0";
  run.environment.buildType = "Release";
  run.environment.cpuModel = "Example CPU";
  run.environment.cpuCores = 8;
  run.environment.distribution = "Debian GNU/Linux 12 (bookworm)";
  run.environment.kernel = "Linux 6.1.0 x86_64";
  run.environment.loadAverage = {0.25, 0.5, 0.125};
  run.environment.timeUtc = "2026-01-31T12:00:00Z";
  run.environment.arguments = {"hlodbench", "run", "--scene", "scene1"};
  run.environment.gl = {"Mesa", "llvmpipe (LLVM 15.0.6, 256 bits)", "4.5 (Core Profile) Mesa"};
  run.warnings = computeWarnings(run.environment);
  run.scene = {"scene1", "00112233445566778899aabbccddeeff", 5000000, 12000,
               json{{"triangles_per_node", 2000}}};
  run.session = {"walk", "ffeeddccbbaa99887766554433221100", 4};
  run.options = json{{"tau_px", 1.0}, {"context", "egl"}};
  run.framesInFlight = 1;
  run.warmUpFrames = 1;
  run.repetitions = 2;
  run.cases = {makeCase("bool", "Bool", 0, 0), makeCase("coh-b", "Coh(B)", 0, 1),
               makeCase("coh-b", "Coh(B)", 1, 2)};
  CaseResult failed;
  failed.key = {"sw-b", 0};
  failed.label = "SW(B)";
  failed.order = 3;
  failed.error = "frame 2: no query result within 10 s";
  run.cases.push_back(failed);
  finishRun(run, {{"bool", 0}, {"coh-b", 0}, {"sw-b", 0}, {"bool", 1}, {"coh-b", 1}, {"sw-b", 1}});
  return run;
}

std::string readError(const json& value) {
  try {
    runResultFromJson(value, "run.json");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::string readErrorAfter(const std::function<void(json&)>& damage) {
  json value = toJson(makeExample());
  damage(value);
  return readError(value);
}

// Equal but for the last bits of numbers, which depend on how a compiler contracts a*b+c.
void expectNear(const json& a, const json& b, const std::string& pointer) {
  if (a.is_number_float() && b.is_number()) {
    EXPECT_NEAR(a.get<double>(), b.get<double>(), 1e-12 * std::abs(a.get<double>())) << pointer;
  } else if (a.is_structured() && a.type() == b.type() && a.size() == b.size()) {
    for (const auto& item : a.items()) {
      ASSERT_TRUE(a.is_array() || b.contains(item.key())) << pointer << "/" << item.key();
      expectNear(item.value(), a.is_array() ? b[std::stoul(item.key())] : b[item.key()],
                 pointer + "/" + item.key());
    }
  } else {
    EXPECT_EQ(a, b) << pointer;
  }
}

}  // namespace

TEST(ResultJson, ReadsBackWhatItWrote) {
  const RunResult run = makeExample();
  EXPECT_EQ(runResultFromJson(toJson(run), "run.json"), run);
  const RunResult empty;
  EXPECT_EQ(runResultFromJson(toJson(empty), "run.json"), empty);
}

TEST(ResultJson, GoesThroughAFileUnchanged) {
  const fs::path folder = fs::temp_directory_path() / fmt::format("hlodbench-run-{}", ::getpid());
  fs::create_directories(folder);
  RunResult run = makeExample();
  run.cases[0].summary->fps = 0.1 + 0.2;        // needs all 17 digits
  run.cases[3].error = "driver said \"\xff\"";  // not UTF-8: replaced, not fatal
  writeRunResult(folder, run);
  RunResult read = readRunResult(folder);
  EXPECT_THAT(*read.cases[3].error, StartsWith("driver said"));
  read.cases[3].error = run.cases[3].error;
  EXPECT_EQ(read, run);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1);
  fs::remove_all(folder);
}

TEST(ResultJson, HasTheFormatOfTheExample) {
  // The example is what tests/cli/test_results_schema.py holds against the schema.
  const fs::path path = fs::path(HLODBENCH_SOURCE_DIR) / "results/example_result.json";
  const std::string text = toJson(makeExample()).dump(2) + "\n";
  if (std::getenv("HLODBENCH_UPDATE_GOLDEN")) writeTextFile(path, text);
  const std::string golden = readTextFile(path);
  expectNear(json::parse(text), json::parse(golden), "");
  EXPECT_EQ(json::parse(golden)["context"]["cpu_governor"], nullptr);
  EXPECT_THAT(golden, StartsWith("{\n  \"schema_version\": \"1.0.0\",\n  \"context\": {"))
      << "the context comes first";
}

TEST(ResultJson, IgnoresWhatALaterMinorVersionAdds) {
  json value = toJson(makeExample());
  value["schema_version"] = "1.7.0";
  value["weather"] = "fine";
  value["cases"][0]["summary"]["counters"]["unheard_of"] = 3;
  EXPECT_EQ(runResultFromJson(value, "run.json"), makeExample());
}

TEST(ResultJson, NamesFileAndPointerOfWhatIsWrong) {
  EXPECT_THAT(readError(json::array()), StartsWith("run.json: /: expected an object, found []"));
  EXPECT_THAT(readErrorAfter([](json& j) { j["schema_version"] = "2.0.0"; }),
              StartsWith("run.json: /schema_version: expected a version 1.x"));
  EXPECT_THAT(readErrorAfter([](json& j) { j["schema_version"] = "10.0.0"; }),
              StartsWith("run.json: /schema_version: "));
  EXPECT_THAT(readErrorAfter([](json& j) { j["scene"].erase("hash"); }),
              StartsWith("run.json: /scene: expected a member \"hash\", found none"));
  EXPECT_THAT(readErrorAfter([](json& j) { j["cases"][1]["label"] = 3; }),
              StartsWith("run.json: /cases/1/label: expected a string, found 3"));
  EXPECT_THAT(
      readErrorAfter([](json& j) { j["cases"][0]["summary"]["counters"]["dn"]["mean"] = "x"; }),
      StartsWith("run.json: /cases/0/summary/counters/dn/mean: expected a number, found \"x\""));
  EXPECT_THAT(readErrorAfter([](json& j) { j["cases"][0]["repetition"] = -1; }),
              StartsWith("run.json: /cases/0/repetition: expected a whole number from 0"));
  EXPECT_THAT(readErrorAfter([](json& j) { j["scene"]["nodes"] = 1.5; }),
              StartsWith("run.json: /scene/nodes: expected a whole number from 0"));
  EXPECT_THAT(readErrorAfter([](json& j) { j["cases"][0]["summary"]["fps"] = 0.0; }),
              StartsWith("run.json: /cases/0/summary/fps: expected a number above 0"));
  EXPECT_THAT(readErrorAfter([](json& j) { j["context"]["load_average"] = {1.0}; }),
              StartsWith("run.json: /context/load_average: expected 3 numbers"));
  EXPECT_THAT(readErrorAfter([](json& j) { j["cases"][3]["error"] = nullptr; }),
              StartsWith("run.json: /cases/3: expected a summary or an error"));
  EXPECT_THAT(readErrorAfter([](json& j) { j["cases"][2]["repetition"] = 0; }),
              StartsWith("run.json: /cases/2: expected each strategy and repetition once"));
  for (const char* name : {"/etc/passwd", "../other/bool-0.csv"})
    EXPECT_THAT(readErrorAfter([&](json& j) { j["cases"][0]["csv"] = name; }),
                StartsWith("run.json: /cases/0/csv: expected a name inside the result folder"));
}

TEST(ResultJson, NamesTheLineOfASyntaxErrorInOneLine) {
  const fs::path folder = fs::temp_directory_path() / fmt::format("hlodbench-bad-{}", ::getpid());
  fs::create_directories(folder);
  const auto readErrorOf = [&](const std::string& text) -> std::string {
    writeTextFile(folder / kResultFileName, text);
    try {
      readRunResult(folder);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  };
  for (const std::string& text :
       {std::string("{\n  \"scene\": \n"), std::string("{\"a\": \"x\ny\"}"), std::string(""),
        std::string("\xff")}) {
    const std::string message = readErrorOf(text);
    EXPECT_THAT(message, StartsWith((folder / "run.json").string() + ": expected JSON: "));
    EXPECT_THAT(message, HasSubstr("line "));
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
  fs::remove_all(folder);
  EXPECT_THROW(readRunResult(folder), InputError);
}

TEST(PaperTable, AgreesWithItsOwnFpsAndNodeCounts) {
  ASSERT_EQ(paperTable1().scenes.size(), 2u);
  std::vector<std::string> outliers;
  for (const PaperScene& scene : paperTable1().scenes) {
    ASSERT_EQ(scene.rows.size(), 4u);
    const PaperRow& coh = *scene.find("coh-b");
    EXPECT_FALSE(coh.speedup);
    for (const PaperRow& row : scene.rows) {
      if (!row.speedup) continue;
      EXPECT_NEAR(coh.fps / row.fps, *row.speedup, 0.015) << scene.label << " " << row.label;
      // What the speedup can be, given that the FPS are rounded to a tenth and it to a hundredth.
      const double least = (coh.fps - 0.05) / (row.fps + 0.05) - 0.005;
      const double most = (coh.fps + 0.05) / (row.fps - 0.05) + 0.005;
      if (*row.speedup < least || *row.speedup > most)
        outliers.push_back(scene.label + " " + row.label);
    }
    EXPECT_NEAR(*coh.d / coh.dn, scene.delayedShare, 0.0001) << scene.label;
    for (const PaperPsnr& psnr : {scene.y, scene.cb, scene.cr}) EXPECT_GT(psnr.mean, 30.0);
  }
  // 191.6 / 47.3 is 4.05; the paper prints 4.04.
  EXPECT_THAT(outliers, testing::ElementsAre("scene 1 SW(B)"));
}

TEST(PaperTable, HasADashWhereAStrategyCannotHaveTheCounter) {
  for (const PaperScene& scene : paperTable1().scenes) {
    for (const char* strategy : {"bool", "sw-b"}) EXPECT_FALSE(scene.find(strategy)->rarn);
    for (const char* strategy : {"bool", "sw-b", "simp-b"}) EXPECT_FALSE(scene.find(strategy)->d);
    EXPECT_TRUE(scene.find("simp-b")->rarn);
    EXPECT_EQ(scene.find("oracle"), nullptr);
  }
  EXPECT_EQ(paperTable1().find("scene3"), nullptr);
}

}  // namespace hlodbench
