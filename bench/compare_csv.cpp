#include <string>

#include "compare_text.h"
#include "csv_text.h"

namespace hlodbench {
namespace {

void addInterval(const std::optional<Interval>& interval, std::vector<std::string>& fields) {
  const Interval none;
  const Interval& i = interval ? *interval : none;
  fields.push_back(interval ? formatCsvNumber(i.value) : "");
  fields.push_back(formatCsvNumber(i.low));
  fields.push_back(formatCsvNumber(i.high));
}

}  // namespace

std::string renderCompareCsv(const Comparison& comparison, const CompareSide& a,
                             const CompareSide& b) {
  std::string out = formatCsvLine({"folder_a",
                                   "strategy_a",
                                   "folder_b",
                                   "strategy_b",
                                   "group",
                                   "key",
                                   "unit",
                                   "a",
                                   "b",
                                   "of",
                                   "different_frames",
                                   "difference",
                                   "difference_low",
                                   "difference_high",
                                   "relative",
                                   "relative_low",
                                   "relative_high",
                                   "p",
                                   "a12",
                                   "verdict",
                                   "reason"});
  for (const ComparePair& pair : comparison.pairs)
    for (const CompareRow& row : pair.rows) {
      std::vector<std::string> fields{a.folder.string(),
                                      pair.strategyA,
                                      b.folder.string(),
                                      pair.strategyB,
                                      row.group,
                                      row.key,
                                      row.unit,
                                      formatCsvNumber(row.a),
                                      formatCsvNumber(row.b),
                                      row.basis,
                                      row.different ? std::to_string(*row.different) : ""};
      addInterval(row.difference, fields);
      addInterval(row.relative, fields);
      fields.push_back(formatCsvNumber(row.p));
      fields.push_back(formatCsvNumber(row.a12));
      fields.push_back(toString(row.judgement.verdict));
      fields.push_back(row.judgement.reason);
      out += formatCsvLine(fields);
    }
  return out;
}

}  // namespace hlodbench
