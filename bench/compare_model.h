#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "compare_side.h"
#include "metrics/verdict.h"

namespace hlodbench {

struct CompareOptions {
  VerdictOptions verdict;
  std::set<std::string> allowed;  // of listAllowances()
};

// One value of A and B, and what its difference means.
struct CompareRow {
  std::string group;  // "counts", "times" or "pictures"
  std::string key;    // of a counter, "fps", or of images.json: "vs_full.y"
  std::string label, unit;
  std::optional<double> a = {}, b = {};       // mean over frames, or median over repetitions
  std::optional<std::size_t> different = {};  // frames, where frames are compared
  std::string basis = {};  // what these are over: "35 frames", "5 and 5 repetitions", "5 pairs"
  std::optional<Interval> difference = {};  // b - a
  std::optional<Interval> relative = {};    // a share
  std::optional<double> p = {}, a12 = {};   // of the U test over repetitions
  Judgement judgement = {};
};

// One strategy of A against one of B.
struct ComparePair {
  std::string strategyA, strategyB;
  std::string labelA, labelB;
  std::vector<CompareRow> rows;
  std::vector<std::string> notes;
};

struct Comparison {
  std::vector<std::string> refusals;  // if there are any, there is nothing else
  std::vector<std::string> notes;
  std::vector<ComparePair> pairs;

  [[nodiscard]] std::size_t count(Verdict verdict) const;
};

// Compares the strategies that both sides have, or the two that are named. Throws InputError when
// there are none.
Comparison computeComparison(const CompareSide& a, const CompareSide& b,
                             const CompareOptions& options);

}  // namespace hlodbench
