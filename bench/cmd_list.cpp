#include <fmt/format.h>

#include "commands.h"
#include "hlod/render/gl_context.h"
#include "metrics/counters.h"
#include "overlay.h"
#include "strategy_settings.h"
#include "traversals/registry.h"

namespace hlodbench {
namespace {

void listEverything() {
  fmt::print("Strategies (--strategy):\n");
  for (const StrategyInfo& s : listStrategies())
    fmt::print("  {:<14} {}: {}\n{}", s.name, s.label, s.description, describeOptions(s));
  fmt::print("\nContexts (--context):\n  {:<14} {}\n", "auto",
             "the first of these that works; says what it tried");
  for (const GlContextInfo& c : listContexts()) fmt::print("  {:<14} {}\n", c.name, c.description);
  fmt::print("\nOverlays (--overlay):\n");
  for (const OverlayInfo& o : listOverlays()) fmt::print("  {:<14} {}\n", o.name, o.description);
  fmt::print("\nCounters (columns of the frame logs):\n");
  for (const CounterInfo& c : kCounterTable)
    fmt::print("  {:<14} {}{}{}\n", c.key, c.description, c.unit.empty() ? "" : ", ", c.unit);
}

}  // namespace

void addListCommand(CLI::App& app) {
  app.add_subcommand("list", "Print the strategies, contexts and counters, one line each")
      ->callback(listEverything);
}

}  // namespace hlodbench
