#include "run_options_json.h"

#include <fmt/format.h>

#include "hlod/tree/hasher.h"
#include "metrics/text_file.h"
#include "readings.h"

namespace hlodbench {
namespace {

nlohmann::json describePlugins(const std::vector<std::filesystem::path>& plugins) {
  nlohmann::json json = nlohmann::json::array();
  for (const std::filesystem::path& file : plugins) {
    const std::string content = readTextFile(file);
    json.push_back(
        {{"file", file.string()},
         {"hash", fmt::format("{:016x}", computeHash(std::as_bytes(std::span(content))))}});
  }
  return json;
}

}  // namespace

nlohmann::json toJson(const RunOptions& options, const StrategySettings& settings,
                      const Lens& lens) {
  const TraversalOptions& t = options.traversal;
  nlohmann::json json = {
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
      {"plugins", describePlugins(options.plugins)},
      {"latency", options.latency},
      {"turn_frames", options.turns ? nlohmann::json(options.turnFrames) : nlohmann::json()},
      {"seed", options.seed},
      {"gpu_memory", options.gpuMemory == kUnlimitedMemory ? nlohmann::json()
                                                           : nlohmann::json(options.gpuMemory)},
      {"images", options.images.name()},
      {"explain", options.explain.name()},
      {"overlays", options.pictures.overlays},
      {"traced", !options.trace.empty()},
  };
  for (const auto& [key, value] : listReadings(t, options.queryFaces)) json[key] = value;
  return json;
}

}  // namespace hlodbench
