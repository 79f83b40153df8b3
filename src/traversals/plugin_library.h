#pragma once

#include <hlodbench/plugin.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "traversals/registry.h"

namespace hlodbench {

// Opens a shared library and returns its strategies. It stays open until the program ends. Throws
// InputError "--plugin FILE: expected ..., found ..." for a file that is none, has no entry point,
// was built for another version or by another kind of compiler, or describes its strategies
// wrongly.
std::vector<StrategyInfo> loadPlugin(const std::filesystem::path& file);

// What is wrong with a plug-in's description, in words; empty if nothing is. Reads no more of it
// than holds for its version.
std::string checkPlugin(const plugin::PluginDescriptor& descriptor);

// Those of the tree and of the plug-ins; onLoad gets the place of each before it is opened. Throws
// InputError as loadPlugin(), and for a name that is there already.
std::vector<StrategyInfo> listStrategies(
    const std::vector<std::filesystem::path>& plugins,
    const std::function<void(int)>& onLoad = [](int) {});

}  // namespace hlodbench
