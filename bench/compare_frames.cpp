// Values that belong to a frame and are no matter of chance.

#include <fmt/format.h>

#include "compare_rows.h"
#include "metrics/summary.h"

namespace hlodbench {

void judgeFrames(const std::vector<double>& a, const std::vector<double>& b,
                 const std::vector<int>& frames, Better better, CompareRow& row) {
  row.a = computeMean(a);
  row.b = computeMean(b);
  row.basis = fmt::format("{} frames", frames.size());
  std::size_t different = 0;
  int first = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] == b[i]) continue;
    if (different == 0) first = frames[i];
    ++different;
  }
  row.different = different;
  if (different == 0) {
    row.difference = Interval{};
    row.judgement = {Verdict::kSame, fmt::format("equal in all {} frames", frames.size())};
    return;
  }
  const Change change = computeMeanChange(a, b);
  row.difference = change.absolute;
  row.relative = change.relative;
  row.judgement.reason =
      fmt::format("differs in {} of {} frames, first in frame {}", different, frames.size(), first);
  row.judgement.verdict = computeDirection(change.absolute.value, better);
  if (row.judgement.verdict == Verdict::kUnclear)
    row.judgement.reason +=
        better == Better::kNeither ? ", and neither direction is better" : ", but not in the mean";
}

}  // namespace hlodbench
