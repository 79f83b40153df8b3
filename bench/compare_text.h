#pragma once

#include <string>

#include "compare_model.h"

namespace hlodbench {

// A comparison for reading, or for programs: Markdown with a table for each pair, CSV with a line
// for each value and a header line, JSON with everything. Numbers in CSV and JSON are not rounded.
std::string renderCompareMarkdown(const Comparison& comparison, const CompareSide& a,
                                  const CompareSide& b, const CompareOptions& options);
std::string renderCompareCsv(const Comparison& comparison, const CompareSide& a,
                             const CompareSide& b);
std::string renderCompareJson(const Comparison& comparison, const CompareSide& a,
                              const CompareSide& b, const CompareOptions& options);

}  // namespace hlodbench
