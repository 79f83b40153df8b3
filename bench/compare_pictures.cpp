// The rows of pictures, frame by frame.

#include <fmt/format.h>

#include <functional>

#include "compare_rows.h"

namespace hlodbench {
namespace {

// A value of one picture; absent where the planes are identical, the ratio infinite.
using Measure = std::function<std::optional<double>(const PictureFrame&)>;

// The pictures of a frame by both sides.
struct FramePair {
  const PictureFrame* a;
  const PictureFrame* b;
};

std::vector<FramePair> pairFrames(const StrategyPictures& a, const StrategyPictures& b) {
  std::vector<FramePair> pairs;
  for (const PictureFrame& ofA : a.frames)
    for (const PictureFrame& ofB : b.frames)
      if (ofA.frame == ofB.frame) pairs.push_back({&ofA, &ofB});
  return pairs;
}

// With the driver's latency the nodes drawn vary a little from run to run: a difference counts only
// where all of its interval is on one side.
void weaken(CompareRow& row) {
  if (row.judgement.verdict == Verdict::kSame) return;
  const auto& d = row.difference;
  const bool clear = d && d->low && d->high && (*d->low > 0.0 || *d->high < 0.0);
  if (clear) return;
  row.judgement.verdict = Verdict::kUnclear;
  row.judgement.reason += "; counts are not exact, and the interval is not on one side of 0";
}

void addRow(const std::vector<FramePair>& pairs, CompareRow row, Better better, bool exactCounts,
            const Measure& measure, ComparePair& pair) {
  std::vector<double> a, b;
  std::vector<int> frames;
  int onlyA = 0;
  int onlyB = 0;
  int both = 0;
  for (const FramePair& frame : pairs) {
    const std::optional<double> ofA = measure(*frame.a);
    const std::optional<double> ofB = measure(*frame.b);
    onlyA += !ofA && ofB ? 1 : 0;
    onlyB += ofA && !ofB ? 1 : 0;
    both += !ofA && !ofB ? 1 : 0;
    if (!ofA || !ofB) continue;
    a.push_back(*ofA);
    b.push_back(*ofB);
    frames.push_back(frame.a->frame);
  }
  if (!frames.empty())
    judgeFrames(a, b, frames, better, row);
  else
    row.judgement = {Verdict::kSame, ""};
  // a plane that is identical has the largest ratio there is
  if (onlyA != onlyB) {
    const Verdict way = computeDirection(onlyB - onlyA, better);
    if (row.judgement.verdict == Verdict::kSame)
      row.judgement.verdict = way;
    else if (row.judgement.verdict != way)
      row.judgement.verdict = Verdict::kUnclear;
  } else if (onlyA > 0 && row.judgement.verdict == Verdict::kSame) {
    row.judgement.verdict = Verdict::kUnclear;
  }
  if (onlyA + onlyB + both > 0)
    row.judgement.reason +=
        fmt::format("{}identical planes left out: {} of both, {} of A alone, {} of B alone",
                    row.judgement.reason.empty() ? "" : "; ", both, onlyA, onlyB);
  if (!exactCounts) weaken(row);
  pair.rows.push_back(std::move(row));
}

void addPsnrRows(const std::vector<FramePair>& pairs, const std::string& key,
                 const std::string& label, bool exactCounts,
                 const std::function<const ComponentPsnr&(const PictureFrame&)>& get,
                 ComparePair& pair) {
  const struct {
    const char* key;
    const char* label;
    std::optional<double> ComponentPsnr::*plane;
  } planes[] = {{"y", "Y", &ComponentPsnr::y},
                {"cb", "Cb", &ComponentPsnr::cb},
                {"cr", "Cr", &ComponentPsnr::cr}};
  for (const auto& plane : planes) {
    CompareRow row{"pictures", key + "." + plane.key, fmt::format("PSNR {} {}", plane.label, label),
                   "dB"};
    addRow(
        pairs, std::move(row), Better::kHigher, exactCounts,
        [&](const PictureFrame& frame) { return get(frame).*plane.plane; }, pair);
    pair.rows.back().relative.reset();  // a share of decibels means nothing
  }
}

}  // namespace

void addPictureRows(const StrategyPictures& a, const StrategyPictures& b, bool exactCounts,
                    ComparePair& pair) {
  const std::vector<FramePair> pairs = pairFrames(a, b);
  if (pairs.empty()) {
    pair.notes.push_back("pictures are not compared: no frame that both have");
    return;
  }
  if (pairs.size() != a.frames.size() || pairs.size() != b.frames.size())
    pair.notes.push_back(fmt::format("pictures: A has {} frames, B {}; compared are the {} of both",
                                     a.frames.size(), b.frames.size(), pairs.size()));
  addPsnrRows(
      pairs, "vs_full", "of full model", exactCounts,
      [](const PictureFrame& f) -> const ComponentPsnr& { return f.vsFull; }, pair);
  std::vector<FramePair> referenced;
  for (const FramePair& frame : pairs)
    if (frame.a->vsReference && frame.b->vsReference) referenced.push_back(frame);
  if (!referenced.empty())
    addPsnrRows(
        referenced, "vs_reference", "of reference", exactCounts,
        [](const PictureFrame& f) -> const ComponentPsnr& { return *f.vsReference; }, pair);
  addRow(
      pairs, {"pictures", "wrong_pixels", "wrong pixels", ""}, Better::kLower, exactCounts,
      [](const PictureFrame& f) { return static_cast<double>(f.wrongPixels); }, pair);
  addRow(
      pairs, {"pictures", "crack_pixels", "crack pixels", ""}, Better::kLower, exactCounts,
      [](const PictureFrame& f) { return static_cast<double>(f.crackPixels); }, pair);
}

}  // namespace hlodbench
