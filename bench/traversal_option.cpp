#include "traversal_option.h"

#include "choice.h"
#include "number_range.h"

namespace hlodbench {

void addTraversalOptions(CLI::App& command, TraversalOptions& options) {
  command
      .add_option("--tau", options.tau,
                  "pixels of error: refine while the error is above it; pixels, > 0")
      ->capture_default_str()
      ->check(makeNumberRange(1e-6, 1e6));
  command.add_option("--s", options.bias.s, "smoothness of the bias, 0 (B = mu) to 1 (sigmoid)")
      ->capture_default_str()
      ->check(makeNumberRange(0.0, 1.0));
  command.add_option("--t", options.bias.t, "turn-over point of the bias, 0 (conservative) to 1")
      ->capture_default_str()
      ->check(makeNumberRange(0.0, 1.0));
  command
      .add_option("--exponent", options.bias.exponent,
                  "steepness of the sigmoid (reconstruction), 1 to 100")
      ->capture_default_str()
      ->check(makeNumberRange(1.0, 100.0));
  addChoice<StaleChildren>(
      command, "--stale-children", options.staleChildren,
      {{"skip", StaleChildren::kSkip}, {"literal", StaleChildren::kLiteral}},
      "children not visited in the last frame: skip them, or read Fig. 3 literally");
  addChoice<ZeroPixels>(command, "--zero-pixels", options.zeroPixels,
                        {{"zero", ZeroPixels::kZeroBias}, {"literal", ZeroPixels::kLiteral}},
                        "bias of a node that passes no pixel: zero, or Fig. 2 literally");
  addChoice<SimpEstimate>(
      command, "--simp", options.simpEstimate,
      {{"last", SimpEstimate::kLastProcessed}, {"mean", SimpEstimate::kRunningMean}},
      "Simp(B), a reconstruction: bias of the last node processed, or their mean");
}

}  // namespace hlodbench
