#include <fmt/format.h>

#include <memory>

#include "commands.h"
#include "hlod/core/error.h"
#include "hlod/render/gl_context.h"
#include "metrics/counters.h"
#include "overlay.h"
#include "plugin_option.h"
#include "strategy_settings.h"
#include "supervisor.h"
#include "traversals/plugin_library.h"

namespace hlodbench {
namespace {

void listEverything(const std::vector<std::filesystem::path>& plugins, Heartbeat& heartbeat) {
  const auto strategies = listStrategies(
      plugins, [&](int plugin) { heartbeat.enter(Heartbeat::Stage::kLoading, plugin); });
  fmt::print("Strategies (--strategy):\n");
  for (const StrategyInfo& s : strategies)
    fmt::print("  {:<14} {}: {}\n{}", s.name, s.label, s.description, describeOptions(s));
  fmt::print("\nContexts (--context):\n  {:<14} {}\n", "auto",
             "the first of these that works; says what it tried");
  for (const GlContextInfo& c : listContexts()) fmt::print("  {:<14} {}\n", c.name, c.description);
  fmt::print("\nOverlays (--overlay):\n");
  for (const OverlayInfo& o : listOverlays()) fmt::print("  {:<14} {}\n", o.name, o.description);
  fmt::print("\nCounters (columns of the frame logs):\n");
  for (const CounterInfo& c : kCounterTable)
    fmt::print("  {:<21} {}{}{}\n", c.key, c.description, c.unit.empty() ? "" : ", ", c.unit);
}

}  // namespace

void addListCommand(CLI::App& app, const std::vector<std::string>& arguments) {
  auto plugins = std::make_shared<std::vector<std::filesystem::path>>();
  CLI::App* sub =
      app.add_subcommand("list", "Print the strategies, contexts and counters, one line each");
  addPluginOption(*sub, *plugins);
  sub->callback([plugins, arguments] {
    Heartbeat alone;
    Watch watch{&alone};
    if (!plugins->empty())
      if (const auto code = supervise(watch, arguments, {.plugins = *plugins}))
        throw CLI::RuntimeError(*code);
    const Leaving leaving(*watch.heartbeat);
    listEverything(*plugins, *watch.heartbeat);
    watch.heartbeat->exitCode = static_cast<int>(ExitCode::kOk);
  });
}

}  // namespace hlodbench
