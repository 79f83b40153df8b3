#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "choice.h"
#include "commands.h"
#include "compare_differences.h"
#include "compare_text.h"
#include "number_range.h"

namespace hlodbench {
namespace {

enum class CompareFormat { kMarkdown, kCsv, kJson };

struct CompareCommand {
  std::string a, b;
  CompareFormat format = CompareFormat::kMarkdown;
  std::vector<std::string> allowed;
  double minChangePercent = 100.0 * VerdictOptions{}.minChange;
  CompareOptions options;
};

std::string listAllowanceNames() {
  std::string names;
  for (const std::string& name : listAllowances()) names += (names.empty() ? "" : ", ") + name;
  return names;
}

void readAllowances(CompareCommand& command) {
  const std::vector<std::string>& known = listAllowances();
  for (const std::string& name : command.allowed) {
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw InputError(
          fmt::format("--allow: expected some of {}, found '{}'", listAllowanceNames(), name));
    command.options.allowed.insert(name);
  }
}

std::string render(const Comparison& comparison, const CompareSide& a, const CompareSide& b,
                   const CompareCommand& command) {
  switch (command.format) {
    case CompareFormat::kMarkdown:
      return renderCompareMarkdown(comparison, a, b, command.options);
    case CompareFormat::kCsv:
      // a table of CSV has no place for them
      for (const std::string& note : comparison.notes) fmt::print(stderr, "note: {}\n", note);
      return renderCompareCsv(comparison, a, b);
    case CompareFormat::kJson:
      return renderCompareJson(comparison, a, b, command.options);
  }
  return {};
}

void compare(CompareCommand& command) {
  readAllowances(command);
  command.options.verdict.minChange = command.minChangePercent / 100.0;
  const CompareSide a = readCompareSide(command.a);
  const CompareSide b = readCompareSide(command.b);
  const Comparison comparison = computeComparison(a, b, command.options);
  for (const std::string& refusal : comparison.refusals)
    fmt::print(stderr, "hlodbench: {}\n", refusal);
  if (!comparison.refusals.empty()) throw CLI::RuntimeError(static_cast<int>(ExitCode::kBadInput));
  fmt::print("{}", render(comparison, a, b, command));
  if (comparison.count(Verdict::kWorse) > 0)
    throw CLI::RuntimeError(static_cast<int>(ExitCode::kCheckFailed));
}

}  // namespace

void addCompareCommand(CLI::App& app) {
  auto command = std::make_shared<CompareCommand>();
  CLI::App* sub = app.add_subcommand(
      "compare",
      "Compare two runs, or two strategies, value by value: SAME, BETTER, WORSE, UNCLEAR");
  sub->add_option("a", command->a,
                  "result folder of `hlodbench run`, or FOLDER:STRATEGY for one strategy in it")
      ->required();
  sub->add_option("b", command->b, "the same, compared against a")->required();
  addChoice<CompareFormat>(*sub, "--format", command->format,
                           {{"markdown", CompareFormat::kMarkdown},
                            {"csv", CompareFormat::kCsv},
                            {"json", CompareFormat::kJson}},
                           "of the output");
  sub->add_option("--allow", command->allowed,
                  "compare although these differ; machine: times, too, although processor, "
                  "OpenGL or build differ; comma-separated (" +
                      listAllowanceNames() + ")")
      ->delimiter(',');
  VerdictOptions& verdict = command->options.verdict;
  sub->add_option("--alpha", verdict.alpha,
                  "a difference over repetitions needs a p below it; 0.000001 to 0.5")
      ->capture_default_str()
      ->check(makeNumberRange(1e-6, 0.5));
  sub->add_option("--effect", verdict.effect,
                  "and an effect size A12 (Vargha-Delaney) of at least it, or of at most 1 - it; "
                  "0.5 to 1")
      ->capture_default_str()
      ->check(makeNumberRange(0.5, 1.0));
  sub->add_option("--min-change", command->minChangePercent,
                  "and a relative change of at least it, per cent, 0 to 100; SAME needs all of the "
                  "change's interval within it")
      ->capture_default_str()
      ->check(makeNumberRange(0.0, 100.0));
  sub->footer(
      "Exit codes: 0 no value is WORSE, 1 some value is WORSE, 2 wrong usage or input, or runs\n"
      "that are not comparable.");
  sub->callback([command] { compare(*command); });
}

}  // namespace hlodbench
