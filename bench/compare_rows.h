#pragma once

#include <vector>

#include "compare_model.h"

namespace hlodbench {

// What the rows of one pair are made from.
struct PairInput {
  const ReplayLogs& a;
  const ReplayLogs& b;
  bool sameRun = false;      // repetitions are interleaved and can be paired
  bool sameSession = true;   // frames can be paired
  bool exactCounts = false;  // the counts are the same in every run
  VerdictOptions verdict;
};

// Adds a row for each counter that both have: the exact ones frame by frame, what is noisy over
// repetitions.
void addCountRows(const PairInput& input, ComparePair& pair);
// Frame rate and times over repetitions.
void addTimeRows(const PairInput& input, ComparePair& pair);
// PSNR, wrong and crack pixels of the frames that both have pictures of. `a` and `b` are these
// strategies' pictures.
void addPictureRows(const StrategyPictures& a, const StrategyPictures& b, bool exactCounts,
                    ComparePair& pair);

// Judges values of the same frames, which are no matter of chance: equal, or which way their mean
// goes. `frames` are their indices.
void judgeFrames(const std::vector<double>& a, const std::vector<double>& b,
                 const std::vector<int>& frames, Better better, CompareRow& row);

}  // namespace hlodbench
