#include "traversals/plugin_library.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <exception>

#include "hlod/core/error.h"
#include "traversals/option_set.h"

namespace hlodbench {
namespace {

using plugin::PluginDescriptor;
using plugin::StrategyDescriptor;

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what) {
  throw InputError(fmt::format("--plugin {}: {}", file.string(), what));
}

bool isLine(const char* text) {
  return text != nullptr && *text != '\0' && std::strpbrk(text, "\r\n") == nullptr;
}

std::string checkStrategy(const StrategyDescriptor& s) {
  if (s.name == nullptr || !isIdentifier(s.name))
    return fmt::format("expected a strategy's name of a-z, 0-9, - and _, found '{}'",
                       s.name == nullptr ? "" : s.name);
  const auto wrong = [&](const std::string& what) {
    return fmt::format("strategy '{}': {}", s.name, what);
  };
  if (!isLine(s.label) || !isLine(s.description))
    return wrong("expected a label and a description of one line each");
  if ((s.makePredictor == nullptr) == (s.makeStrategy == nullptr))
    return wrong("expected a predictor or a strategy");
  if (s.optionCount > 0 && s.options == nullptr) return wrong("expected its options");
  const std::string options = checkOptionInfos({s.options, s.optionCount});
  return options.empty() ? "" : wrong(options);
}

}  // namespace

std::string checkPlugin(const PluginDescriptor& d) {
  if (std::memcmp(d.magic, plugin::kPluginMagic, sizeof d.magic) != 0)
    return "expected a plug-in of hlodbench, found another one's";
  if (d.apiMajor != HLODBENCH_API_MAJOR || d.apiMinor > HLODBENCH_API_MINOR)
    return fmt::format(
        "expected one built for version {}.0 to {}.{} of <hlodbench/plugin.h>, found {}.{}",
        HLODBENCH_API_MAJOR, HLODBENCH_API_MAJOR, HLODBENCH_API_MINOR, d.apiMajor, d.apiMinor);
  if (std::strcmp(d.abi, HLODBENCH_ABI) != 0)
    return fmt::format("expected one built with {}, found {} (compiler {})", HLODBENCH_ABI, d.abi,
                       d.compiler);
  // arrays of these are walked, so their sizes never change; a view may have grown since
  if (d.nodeBytes != sizeof(plugin::Node) || d.stateBytes != sizeof(plugin::NodeState) ||
      d.optionBytes != sizeof(plugin::OptionInfo) ||
      d.strategyBytes != sizeof(StrategyDescriptor) || d.viewBytes > sizeof(plugin::FrameView))
    return fmt::format("expected structs laid out as here, found others (compiler {})", d.compiler);
  if (d.list.count == 0 || d.list.strategies == nullptr)
    return "expected at least one strategy, found none";
  for (std::uint32_t i = 0; i < d.list.count; ++i)
    if (std::string wrong = checkStrategy(d.list.strategies[i]); !wrong.empty()) return wrong;
  return "";
}

std::vector<StrategyInfo> loadPlugin(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored))
    fail(file, "expected a shared library, found no file");
  // with a path, so that the loader does not look elsewhere
  void* const library = dlopen(std::filesystem::absolute(file).c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    std::string reason = dlerror();
    std::replace(reason.begin(), reason.end(), '\n', ' ');
    fail(file, "expected a shared library that can be loaded, found: " + reason);
  }
  void* const entry = dlsym(library, plugin::kPluginEntry);
  if (entry == nullptr)
    fail(file, fmt::format("expected a plug-in, found a library without the function {}",
                           plugin::kPluginEntry));
  const PluginDescriptor* const descriptor = reinterpret_cast<plugin::PluginEntry>(entry)();
  if (descriptor == nullptr) fail(file, "expected a description, found none");
  if (const std::string wrong = checkPlugin(*descriptor); !wrong.empty()) fail(file, wrong);
  std::vector<StrategyInfo> infos;
  for (std::uint32_t i = 0; i < descriptor->list.count; ++i)
    infos.push_back(describeStrategy(descriptor->list.strategies[i]));
  return infos;
}

std::vector<StrategyInfo> listStrategies(const std::vector<std::filesystem::path>& plugins,
                                         const std::function<void(int)>& onLoad) {
  const std::span<const StrategyInfo> ours = listStrategies();
  std::vector<StrategyInfo> all(ours.begin(), ours.end());
  for (std::size_t i = 0; i < plugins.size(); ++i) {
    onLoad(static_cast<int>(i));
    for (const StrategyInfo& info : loadPlugin(plugins[i])) {
      if (std::any_of(all.begin(), all.end(),
                      [&](const StrategyInfo& other) { return other.name == info.name; }))
        fail(plugins[i],
             fmt::format("expected strategies with new names, found '{}' again", info.name));
      all.push_back(info);
    }
  }
  return all;
}

}  // namespace hlodbench
