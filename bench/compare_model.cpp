#include "compare_model.h"

#include <fmt/format.h>

#include <algorithm>

#include "compare_differences.h"
#include "compare_rows.h"
#include "hlod/core/error.h"

namespace hlodbench {
namespace {

using StrategyPair = std::pair<std::string, std::string>;

std::string listNames(const CompareSide& side) {
  std::string names;
  for (const auto& [strategy, logs] : side.logs) names += (names.empty() ? "" : ", ") + strategy;
  return names.empty() ? "none" : names;
}

// In the order in which A ran them. A side that names a strategy lends it to one that does not.
std::vector<StrategyPair> pairStrategies(const CompareSide& a, const CompareSide& b) {
  const std::string& only = a.strategy.empty() ? b.strategy : a.strategy;
  if (!only.empty()) {
    const std::string& ofB = b.strategy.empty() ? only : b.strategy;
    if (a.logs.count(only) && b.logs.count(ofB)) return {{only, ofB}};
  } else {
    std::vector<StrategyPair> pairs;
    for (const CaseResult& c : a.run.cases) {
      const StrategyPair pair{c.key.strategy, c.key.strategy};
      if (a.logs.count(c.key.strategy) && b.logs.count(c.key.strategy) &&
          std::find(pairs.begin(), pairs.end(), pair) == pairs.end())
        pairs.push_back(pair);
    }
    if (!pairs.empty()) return pairs;
  }
  throw InputError(
      fmt::format("compare: expected a strategy that ran in both, found {} in {} and {} in {}",
                  listNames(a), a.argument, listNames(b), b.argument));
}

// What of a side cannot be compared, and what its run warned of.
void noteState(const char* name, const CompareSide& side, std::vector<std::string>& notes) {
  for (const CaseResult& c : side.run.cases)
    if (c.error)
      notes.push_back(fmt::format("{}: {} repetition {} failed: {}", name,
                                  side.label(c.key.strategy), c.key.repetition, *c.error));
  if (!side.run.complete) {
    std::string missing;
    for (const CaseKey& key : side.run.missing)
      missing += fmt::format("{}{} repetition {}", missing.empty() ? "" : ", ",
                             side.label(key.strategy), key.repetition);
    notes.push_back(fmt::format("{}: incomplete run, missing: {}", name,
                                missing.empty() ? "not known what" : missing));
  }
  if (side.images && !side.images->complete)
    notes.push_back(fmt::format("{}: pictures are missing, the run was interrupted", name));
  for (const std::string& warning : side.run.warnings)
    notes.push_back(fmt::format("{}: warning: {}", name, warning));
}

void noteStrategiesOfOne(const CompareSide& a, const CompareSide& b,
                         std::vector<std::string>& notes) {
  if (!a.strategy.empty() || !b.strategy.empty()) return;
  for (const auto& [strategy, logs] : a.logs)
    if (!b.logs.count(strategy)) notes.push_back(fmt::format("{}: only A has it", strategy));
  for (const auto& [strategy, logs] : b.logs)
    if (!a.logs.count(strategy)) notes.push_back(fmt::format("{}: only B has it", strategy));
}

bool isSameFolder(const CompareSide& a, const CompareSide& b) {
  std::error_code ignored;
  return std::filesystem::equivalent(a.folder, b.folder, ignored);
}

// How pictures of the two runs relate; nothing where they can be compared.
std::optional<std::string> findPictureObstacle(const CompareSide& a, const CompareSide& b) {
  if (!a.images || !b.images)
    return fmt::format("{} no pictures", !a.images && !b.images ? "both have"
                                         : !a.images            ? "A has"
                                                                : "B has");
  if (a.images->width != b.images->width || a.images->height != b.images->height)
    return fmt::format("A's have {}x{} pixels, B's {}x{}", a.images->width, a.images->height,
                       b.images->width, b.images->height);
  if (a.run.session.hash != b.run.session.hash) return "the sessions differ";
  return std::nullopt;
}

class Comparer {
 public:
  Comparer(const CompareSide& a, const CompareSide& b, const CompareOptions& options)
      : a_(a),
        b_(b),
        options_(options),
        sameRun_(isSameFolder(a, b)),
        differences_(findDifferences(a.run, b.run, options.allowed)),
        countObstacle_(findCountObstacle(a.run)),
        pictureObstacle_(findPictureObstacle(a, b)) {
    if (!countObstacle_) countObstacle_ = findCountObstacle(b.run);
  }

  Comparison compare() {
    if (!differences_.refusals.empty()) {
      result_.refusals = differences_.refusals;
      return std::move(result_);
    }
    for (const auto& [ofA, ofB] : pairStrategies(a_, b_)) addPair(ofA, ofB);
    addNotes();
    return std::move(result_);
  }

 private:
  void addPair(const std::string& ofA, const std::string& ofB) {
    ComparePair pair{ofA, ofB, a_.label(ofA), b_.label(ofB), {}, {}};
    const PairInput input{a_.logs.at(ofA),
                          b_.logs.at(ofB),
                          sameRun_,
                          differences_.sameSession,
                          !countObstacle_.has_value(),
                          options_.verdict};
    addCountRows(input, pair);
    if (!differences_.timesObstacle) addTimeRows(input, pair);
    const StrategyPictures* picturesA = a_.findPictures(ofA);
    const StrategyPictures* picturesB = b_.findPictures(ofB);
    if (!pictureObstacle_ && picturesA && picturesB)
      addPictureRows(*picturesA, *picturesB, input.exactCounts, pair);
    else if (!pictureObstacle_)
      pair.notes.push_back(fmt::format("pictures are not compared: {} has none of this strategy",
                                       picturesA ? "B" : "A"));
    result_.pairs.push_back(std::move(pair));
  }

  void addNotes() {
    std::vector<std::string>& notes = result_.notes;
    notes = differences_.notes;
    noteStrategiesOfOne(a_, b_, notes);
    noteState("A", a_, notes);
    if (!sameRun_) noteState("B", b_, notes);
    if (countObstacle_)
      notes.push_back(
          fmt::format("counts are not exact with {}: they are compared over "
                      "repetitions, as times are",
                      *countObstacle_));
    if (differences_.timesObstacle)
      notes.push_back(*differences_.timesObstacle);
    else if (!sameRun_)
      notes.push_back(
          "two runs: whatever else changed on the machine between them is in the times, too");
    else
      notes.push_back("one run: times are paired within its interleaved repetitions");
    if (pictureObstacle_)
      notes.push_back("pictures are not compared: " + *pictureObstacle_);
    else if (!sameRun_)
      notes.push_back("PSNR of reference: each run's pictures against its own reference's");
    addChanceNote();
  }

  void addChanceNote() {
    std::size_t tests = 0;
    for (const ComparePair& pair : result_.pairs)
      for (const CompareRow& row : pair.rows) tests += row.p ? 1 : 0;
    if (tests > 1)
      result_.notes.push_back(fmt::format(
          "{} tests: if nothing had changed, chance alone would put up to {:.2g} of "
          "them below p = {:g}",
          tests, options_.verdict.alpha * static_cast<double>(tests), options_.verdict.alpha));
  }

  const CompareSide& a_;
  const CompareSide& b_;
  const CompareOptions& options_;
  bool sameRun_;
  RunDifferences differences_;
  std::optional<std::string> countObstacle_, pictureObstacle_;
  Comparison result_;
};

}  // namespace

std::size_t Comparison::count(Verdict verdict) const {
  std::size_t found = 0;
  for (const ComparePair& pair : pairs)
    for (const CompareRow& row : pair.rows) found += row.judgement.verdict == verdict ? 1 : 0;
  return found;
}

Comparison computeComparison(const CompareSide& a, const CompareSide& b,
                             const CompareOptions& options) {
  return Comparer(a, b, options).compare();
}

}  // namespace hlodbench
