#include "run_options_json.h"

namespace hlodbench {

nlohmann::json toJson(const RunOptions& options, const StrategySettings& settings,
                      const Lens& lens) {
  const TraversalOptions& t = options.traversal;
  return {
      {"strategies", options.strategies},
      {"repetitions", options.repetitions},
      {"context", options.context},
      {"viewport", {lens.width, lens.height}},
      {"faces", options.faces == FaceCulling::kNone ? "both" : "front"},
      {"tau", t.tau},
      {"s", t.bias.s},
      {"t", t.bias.t},
      {"exponent", t.bias.exponent},
      {"stale_children", t.staleChildren == StaleChildren::kSkip ? "skip" : "literal"},
      {"zero_pixels", t.zeroPixels == ZeroPixels::kZeroBias ? "zero" : "literal"},
      {"simp", t.simpEstimate == SimpEstimate::kLastProcessed ? "last" : "mean"},
      {"strategy_options", settings.toJson()},
      {"latency", options.latency},
      {"seed", options.seed},
      {"gpu_memory", options.gpuMemory == kUnlimitedMemory ? nlohmann::json()
                                                           : nlohmann::json(options.gpuMemory)},
      {"images", options.images.name()},
      {"overlays", options.pictures.overlays},
      {"traced", !options.trace.empty()},
  };
}

}  // namespace hlodbench
