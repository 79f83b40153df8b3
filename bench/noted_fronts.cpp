#include "noted_fronts.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "hlod/core/error.h"
#include "metrics/text_file.h"

namespace hlodbench {

void writeNotedFronts(const std::filesystem::path& file,
                      const std::vector<StrategyFronts>& fronts) {
  nlohmann::json json = nlohmann::json::array();
  for (const StrategyFronts& strategy : fronts) {
    nlohmann::json frames = nlohmann::json::array();
    for (const Front& front : strategy.fronts) {
      nlohmann::json nodes = nlohmann::json::array();
      for (const DrawnNode& drawn : front.nodes)
        nodes.push_back({drawn.node, drawn.bias, drawn.refined});
      frames.push_back({front.frame, std::move(nodes)});
    }
    json.push_back({strategy.strategy, strategy.label, std::move(frames)});
  }
  writeTextFile(file, json.dump());
}

std::vector<StrategyFronts> readNotedFronts(const std::filesystem::path& file) {
  std::vector<StrategyFronts> fronts;
  try {
    for (const nlohmann::json& strategy : nlohmann::json::parse(readTextFile(file))) {
      StrategyFronts& made = fronts.emplace_back(
          StrategyFronts{strategy.at(0).get<std::string>(), strategy.at(1).get<std::string>(), {}});
      for (const nlohmann::json& frame : strategy.at(2)) {
        Front& front = made.fronts.emplace_back(Front{frame.at(0).get<int>(), {}});
        for (const nlohmann::json& node : frame.at(1))
          front.nodes.push_back(
              {node.at(0).get<NodeId>(), node.at(1).get<float>(), node.at(2).get<bool>()});
      }
    }
  } catch (const nlohmann::json::exception& error) {
    throw InputError(
        fmt::format("{}: expected noted fronts, found: {}", file.string(), error.what()));
  }
  return fronts;
}

}  // namespace hlodbench
