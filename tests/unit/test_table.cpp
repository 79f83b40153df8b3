#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "hlod/core/error.h"
#include "metrics/text_file.h"
#include "table.h"
#include "table_fixture.h"

namespace hlodbench {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

std::vector<std::string> splitLines(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

// The cells of all table lines, without the padding.
std::vector<std::vector<std::string>> parseMarkdown(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  for (const std::string& line : splitLines(text)) {
    if (line.empty() || line[0] != '|') continue;
    std::vector<std::string> cells;
    std::istringstream in(line.substr(1));
    for (std::string cell; std::getline(in, cell, '|');) {
      const std::size_t begin = cell.find_first_not_of(' ');
      cells.push_back(
          begin == cell.npos ? "" : cell.substr(begin, cell.find_last_not_of(' ') - begin + 1));
    }
    rows.push_back(cells);
  }
  return rows;
}

std::size_t countCodePoints(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

}  // namespace

TEST_F(Table, SetsThePapersValuesUnderOursInThePapersOrder) {
  const auto rows =
      parseMarkdown(renderTable({write("a", makeRun("scene1", 1))}, TableFormat::kMarkdown));
  ASSERT_EQ(rows.size(), 10u);
  EXPECT_THAT(rows[0], ElementsAre("Scenario", "Values", "DN", "RARN", "D", "FPS", "frame FPS",
                                   "Speedup [95 %]"));
  EXPECT_THAT(rows[2],
              ElementsAre("Bool", "this run", "217.0", "–", "–", "169.9", "169.9", "1.13"));
  EXPECT_THAT(rows[3], ElementsAre("Bool", "paper, scene 1", "217", "–", "–", "169.9", "", "1.13"));
  EXPECT_THAT(rows[4], ElementsAre("SW(B)", "this run", "181.4", "–", "–", "47.3", "47.3", "4.05"));
  EXPECT_THAT(rows[5],
              ElementsAre("SW(B)", "paper, scene 1", "181.4", "–", "–", "47.3", "", "4.04"));
  EXPECT_THAT(rows[6],
              ElementsAre("Simp*(B)", "this run", "200.0", "5.00", "–", "173.6", "173.6", "1.10"));
  EXPECT_THAT(rows[7],
              ElementsAre("Simp(B)", "paper, scene 1", "200", "5", "–", "173.6", "", "1.10"));
  EXPECT_THAT(rows[8],
              ElementsAre("Coh(B)", "this run", "183.3", "0.10", "4.70", "191.6", "191.6", "–"));
  EXPECT_THAT(rows[9],
              ElementsAre("Coh(B)", "paper, scene 1", "183.3", "0.1", "4.7", "191.6", "", "–"));
}

TEST_F(Table, SaysTheRatiosThePaperDiscusses) {
  const std::string text = renderTable({write("a", makeRun("scene1", 1))}, TableFormat::kMarkdown);
  EXPECT_THAT(text, HasSubstr("the paper's (scene 1): Coh/SW 1.010 (1.010), Simp*/SW 1.103 (1.103)"
                              ", SW/Bool 0.836 (0.836), D/DN of Coh 2.56 % (2.56 %)"));
}

TEST_F(Table, AveragesOverFramesOfAllRepetitionsAndPairsSpeedups) {
  // Repetition 1 takes twice as long: 3 periods for 2 passes, while every ratio stays.
  const auto rows =
      parseMarkdown(renderTable({write("a", makeRun("scene1", 2))}, TableFormat::kMarkdown));
  EXPECT_EQ(rows[2][5], fmt::format("{:.1f}", 169.9 / 1.5));
  EXPECT_EQ(rows[2][6], fmt::format("{:.1f}", 169.9 * 0.75));
  EXPECT_EQ(rows[2][7], "1.13 [1.13, 1.13]");
}

TEST_F(Table, WeighsRepetitionsByTheirFrames) {
  RunResult run = makeRun("scene1", 2);
  for (CaseResult& result : run.cases) {
    if (result.key.strategy != "bool" || result.key.repetition != 1) continue;
    std::vector<FrameRecord> one(1);
    one[0].set(Counter::kDn, 317.0);
    result.summary = computeSummary(one);
  }
  const auto rows = parseMarkdown(renderTable({write("a", run)}, TableFormat::kMarkdown));
  EXPECT_EQ(rows[2][2], "237.0");  // (4 * 217 + 317) / 5
  EXPECT_EQ(rows[2][5], "169.9");  // the repetition without frame times says nothing of FPS
}

TEST_F(Table, ShowsAnotherSceneBesideBothOfThePaperAndSaysSo) {
  const std::string text =
      renderTable({write("a", makeRun("courtyard", 1))}, TableFormat::kMarkdown);
  const auto rows = parseMarkdown(text);
  ASSERT_EQ(rows.size(), 14u);
  EXPECT_EQ(rows[3][1], "other: paper's scene 1");
  EXPECT_THAT(rows[4],
              ElementsAre("Bool", "other: paper's scene 2", "468.5", "–", "–", "92.9", "", "1.40"));
  EXPECT_THAT(text, HasSubstr("\"courtyard\" is not a scene of the paper"));
  EXPECT_THAT(text, HasSubstr("(scene 1; scene 2): Coh/SW 1.010 (1.010; 1.006)"));
  EXPECT_THAT(renderTable({write("b", makeRun("scene2", 1))}, TableFormat::kMarkdown),
              Not(HasSubstr("other: ")));
}

TEST_F(Table, KeepsItsColumnsAlignedInATerminal) {
  RunResult run = makeRun("scene1", 5);
  run.cases[0].label = "Coh(B) élargi";  // two bytes, one column
  std::size_t width = 0;
  for (const std::string& line :
       splitLines(renderTable({write("a", run)}, TableFormat::kMarkdown))) {
    if (line.empty() || line[0] != '|') continue;
    if (width == 0) width = countCodePoints(line);
    EXPECT_EQ(countCodePoints(line), width) << line;
  }
  EXPECT_GT(width, 40u);
  EXPECT_LE(width, 100u);
}

TEST_F(Table, ExplainsItselfBelow) {
  const std::string text = renderTable({write("a", makeRun("scene1", 1))}, TableFormat::kMarkdown);
  EXPECT_THAT(text,
              HasSubstr("Warm-up frames before each repetition are excluded; there were 10."));
  EXPECT_THAT(text, HasSubstr("* reconstruction, see docs/deviations.md; not the authors' method"));
  EXPECT_THAT(text, HasSubstr("FPS: frames over total time"));
  EXPECT_THAT(text, HasSubstr("ISVC 2007"));
}

TEST_F(Table, NamesFailedCasesAndWhatIsMissing) {
  RunResult run = makeRun("scene1", 2);
  for (CaseResult& result : run.cases) {
    if (result.key.strategy != "sw-b") continue;
    result.error = "frame 7: query | lost";
    result.summary.reset();
  }
  run.cases.pop_back();
  run.missing = {{"simp-b", 1}, {"oracle", 0}, {"oracle", 1}};
  run.complete = false;
  run.warnings = {"software rasteriser"};
  const std::string text = renderTable({write("a", run)}, TableFormat::kMarkdown);
  EXPECT_THAT(text, HasSubstr("SW(B) repetition 1 failed: frame 7: query \\| lost"));
  EXPECT_THAT(text,
              HasSubstr("incomplete run, missing: Simp*(B) repetition 1; oracle repetition 0, 1"));
  EXPECT_THAT(text, HasSubstr("warning: software rasteriser"));
  EXPECT_THAT(text, HasSubstr("Coh/SW n/a (1.010)"));
  EXPECT_THAT(parseMarkdown(text)[4],
              ElementsAre("SW(B)", "this run", "n/a", "–", "–", "n/a", "n/a", "n/a"));
}

TEST_F(Table, PutsOtherStrategiesAfterThePapersById) {
  RunResult run = makeRun("scene1", 1);
  for (const TableValues& values : {TableValues{"oracle", "Oracle|x", 180.0, 0.0, 0.0, 200.0},
                                    TableValues{"full", "Full", 900, 0, 0, 9}}) {
    CaseResult result;
    result.key = {values.strategy, 0};
    result.label = values.label;
    result.summary = makeSummary(values, 1.0);
    run.cases.insert(run.cases.begin(), result);
  }
  const std::string text = renderTable({write("a", run)}, TableFormat::kMarkdown);
  const auto rows = parseMarkdown(text);
  ASSERT_EQ(rows.size(), 12u);
  EXPECT_THAT(rows[10], ElementsAre("Full", "this run", "900.0", "0.00", "0.00", "9.0", "9.0",
                                    "21.29", "4.5 %"));
  EXPECT_THAT(text, HasSubstr("| Oracle\\|x |"));
}

// Oracle, in these repetitions, `times` as fast as the paper's Bool.
void addOracle(RunResult& run, const std::vector<double>& times) {
  for (std::size_t i = 0; i < times.size(); ++i) {
    const TableValues values{"oracle", "Oracle", 181.4, 0.0, -1.0, 169.9 * times[i]};
    CaseResult result;
    result.key = {values.strategy, static_cast<int>(i)};
    result.label = values.label;
    result.csv = "x.csv";
    result.summary = makeSummary(values, 1.0 + static_cast<double>(i));
    run.cases.push_back(std::move(result));
  }
}

void addExplanation(RunResult& run, const std::string& strategy,
                    const std::vector<std::pair<Counter, double>>& values) {
  for (CaseResult& result : run.cases) {
    if (result.key != CaseKey{strategy, 0}) continue;
    std::vector<FrameRecord> records(2);
    for (const auto& [counter, value] : values) records[1].set(counter, value);
    const Summary explained = computeSummary(records);
    for (std::size_t i = 0; i < kCounterCount; ++i)
      if (explained.counters[i]) result.summary->counters[i] = explained.counters[i];
  }
}

TEST_F(Table, StatesEachStrategyAsAShareOfTheOracle) {
  RunResult run = makeRun("scene1", 3);
  addOracle(run, {2.0, 4.0, 2.5});
  const std::string text = renderTable({write("a", run)}, TableFormat::kMarkdown);
  const auto rows = parseMarkdown(text);
  EXPECT_EQ(rows[0].back(), "of Oracle's FPS");
  // within a repetition: 1/2, 1/4, 1/2.5
  EXPECT_EQ(rows[2].back(), "40.0 % [25.0, 50.0]");
  EXPECT_EQ(rows[3].back(), "") << "the paper has no oracle";
  EXPECT_THAT(rows.back(), testing::Contains("Oracle"));
  EXPECT_EQ(rows.back().back(), "–");
  EXPECT_THAT(text, HasSubstr("docs/limits.md"));
  EXPECT_THAT(renderTable({root_ / "a"}, TableFormat::kLatex),
              HasSubstr("Bool & this run & 40.0 \\% [25.0, 50.0] \\\\"));
  // beside a run without it, which has no such column, or empty fields
  const fs::path without = write("b", makeRun("scene1", 3));
  EXPECT_EQ(parseMarkdown(renderTable({without}, TableFormat::kMarkdown))[0].size(), 8u);
  EXPECT_THAT(renderTable({without}, TableFormat::kCsv), Not(HasSubstr("limit")));
  EXPECT_THAT(renderTable({without}, TableFormat::kMarkdown), Not(HasSubstr("Oracle")));
  const auto lines = splitLines(renderTable({root_ / "a", without}, TableFormat::kCsv));
  EXPECT_THAT(lines[0],
              testing::EndsWith(",ours_limit_share,ours_limit_share_low,ours_limit_share_high"));
  EXPECT_THAT(lines[1], testing::HasSubstr(",bool,"));
  std::istringstream fields(lines[1].substr(lines[1].rfind(",,") + 2));
  double share = 0.0;
  char comma = 0;
  double low = 0.0;
  fields >> share >> comma >> low;
  EXPECT_NEAR(share, 0.4, 1e-12);
  EXPECT_NEAR(low, 0.25, 1e-12);
  const auto commas = std::count(lines[0].begin(), lines[0].end(), ',');
  for (const std::string& line : lines)
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), commas) << line;
  EXPECT_THAT(lines.back(), testing::EndsWith(",,,"));
}

TEST_F(Table, ExplainsTheCostsWhereTheRunDoes) {
  RunResult run = makeRun("scene1", 2);
  EXPECT_THAT(renderTable({write("a", run)}, TableFormat::kMarkdown), Not(HasSubstr("Why")));
  addExplanation(run, "coh-b",
                 {{Counter::kPredictedRight, 170},
                  {Counter::kTooConservative, 20},
                  {Counter::kTooAggressive, 1},
                  {Counter::kNeedlessDelays, 9},
                  {Counter::kInvisibleNodes, 31},
                  {Counter::kVisibleTriangles, 4000},
                  {Counter::kInvisibleTriangles, 6000}});
  addExplanation(run, "bool", {{Counter::kInvisibleNodes, 40}});
  const std::string text = renderTable({write("b", run)}, TableFormat::kMarkdown);
  EXPECT_THAT(text, HasSubstr("Why, in 1 frames of the first repetition."));
  const auto rows = parseMarkdown(text);
  ASSERT_EQ(rows.size(), 14u);
  EXPECT_THAT(rows[12],
              ElementsAre("Bool", "this run", "n/a", "n/a", "n/a", "n/a", "n/a", "40.0", "n/a"));
  EXPECT_THAT(rows[13], ElementsAre("Coh(B)", "this run", "200.0", "85.0 %", "20.00", "1.00",
                                    "9.00", "31.0", "2.50"));
  EXPECT_THAT(renderTable({root_ / "b"}, TableFormat::kLatex),
              HasSubstr("Coh(B) & this run & 200.0 & 85.0 \\%"));
}

TEST_F(Table, WritesLatexWithNothingUnescaped) {
  RunResult run = makeRun("scene1", 1);
  run.scene.name = "a_b%c&d#e$f{g}h~i^j\\k";
  const std::string text = renderTable({write("a", run)}, TableFormat::kLatex);
  EXPECT_THAT(text, HasSubstr("a\\_b\\%c\\&d\\#e\\$f\\{g\\}h\\textasciitilde{}i\\textasciicircum{}"
                              "j\\textbackslash{}k"));
  for (const char* part : {"\\toprule", "\\midrule", "\\bottomrule", "\\addlinespace",
                           "\\begin{tabular}{llrrrrrr}", "Bool & this run & 217.0 & -- & -- & "})
    EXPECT_THAT(text, HasSubstr(part));
  EXPECT_THAT(text, Not(HasSubstr("–")));
  for (const std::string& line : splitLines(text)) {
    if (line.find(" & ") == line.npos || line.find("\\\\") == line.npos) continue;
    std::size_t separators = 0;
    for (std::size_t at = line.find('&'); at != line.npos; at = line.find('&', at + 1))
      separators += at > 0 && line[at - 1] == '\\' ? 0u : 1u;
    EXPECT_EQ(separators, 7u) << line;
  }
}

TEST_F(Table, WritesLatexThatCompiles) {
  if (std::system("pdflatex -version >/dev/null 2>&1 && kpsewhich booktabs.sty >/dev/null") != 0)
    GTEST_SKIP() << "no pdflatex with booktabs: whether the LaTeX table compiles was not tested";
  RunResult run = makeRun("a_b%c&d#e$f{g}h~i^j\\k<|>\"", 5);
  for (CaseResult& result : run.cases)
    if (result.key.strategy == "bool") result.label = "[x]*";
  addOracle(run, {1.5, 1.4, 1.6, 1.5, 1.5});
  addExplanation(run, "coh-b", {{Counter::kInvisibleNodes, 31}});
  writeTextFile(
      root_ / "table.tex",
      renderTable({write("a", makeRun("scene1", 5)), write("b", run)}, TableFormat::kLatex));
  writeTextFile(root_ / "all.tex",
                "\\documentclass{article}\n\\usepackage{booktabs}\n\\begin{document}\n"
                "\\input{table.tex}\n\\end{document}\n");
  const std::string command = fmt::format(
      "cd '{}' && pdflatex -interaction=nonstopmode -halt-on-error all.tex >/dev/null 2>&1",
      root_.string());
  EXPECT_EQ(std::system(command.c_str()), 0);
  const std::string log = readTextFile(root_ / "all.log");
  EXPECT_THAT(log, Not(HasSubstr("Overfull \\hbox"))) << "wider than a page";
}

TEST_F(Table, WritesCsvWithOursAndThePapersValues) {
  RunResult other = makeRun("court,yard", 1);
  const fs::path first = write("a", makeRun("scene1", 2));
  const auto lines = splitLines(renderTable({first, write("b", other)}, TableFormat::kCsv));
  ASSERT_EQ(lines.size(), 9u);
  EXPECT_THAT(lines[0], HasSubstr(",ours_dn,ours_rarn,"));
  EXPECT_THAT(lines[0], HasSubstr(",paper_dn,paper_rarn,"));
  const auto commas = std::count(lines[0].begin(), lines[0].end(), ',');
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_EQ(std::count(lines[i].begin(), lines[i].end(), ','), commas) << lines[i];
  EXPECT_THAT(lines[1],
              testing::StartsWith(first.string() + ",scene1,walk,bool,Bool,2,0,8,1,217,"));
  EXPECT_THAT(lines[1], testing::EndsWith(",scene 1,217,,,169.9,1.13,,,,,,,,,,,,"));
  EXPECT_THAT(lines[5], HasSubstr(",\"court,yard\",walk,bool,"));
  EXPECT_THAT(lines[5], testing::EndsWith(",,,,,,,"));
}

TEST_F(Table, RefusesWhatIsNoResultFolder) {
  EXPECT_THROW(renderTable({}, TableFormat::kMarkdown), InputError);
  try {
    renderTable({write("a", makeRun("scene1", 1)), root_ / "nowhere"}, TableFormat::kMarkdown);
    FAIL() << "took a folder that is not there";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("nowhere: expected a result folder with a run.json"));
  }
}

TEST_F(Table, TakesARunThatWasInterruptedBeforeAnything) {
  RunResult run = makeRun("scene1", 1);
  run.cases.clear();
  finishRun(run, {{"bool", 0}});
  for (const TableFormat format : {TableFormat::kMarkdown, TableFormat::kLatex, TableFormat::kCsv})
    EXPECT_FALSE(renderTable({write("a", run)}, format).empty());
}

}  // namespace hlodbench
