#include <fmt/format.h>

#include <memory>

#include "commands.h"
#include "depth_complexity.h"
#include "hierarchy_info.h"
#include "hlod/core/error.h"
#include "hlod/tree/hlod_file.h"

namespace hlodbench {
namespace {

struct InfoCommand {
  std::filesystem::path file, session;
  bool json = false;
  bool check = false;
  std::string context = "auto";
  int every = 10;
};

void showInfo(const InfoCommand& command) {
  HlodFileInfo info;
  const Hierarchy hierarchy = readHlodFile(command.file, &info);
  if (command.check)
    for (NodeId id = 0; id < hierarchy.nodes.size(); ++id) checkGeometryHash(hierarchy, id);
  if (command.json)
    fmt::print("{}", formatNodesJson(hierarchy));
  else
    fmt::print("{}", formatSummary(hierarchy, info));
  if (command.check) {
    const std::string problem = validate(hierarchy);
    if (!problem.empty()) {
      fmt::print(stderr, "hlodbench: {}: {}\n", command.file.string(), problem);
      throw CLI::RuntimeError(static_cast<int>(ExitCode::kCheckFailed));
    }
    fmt::print(stderr, "{}: every check holds\n", command.file.string());
  }
  if (!command.session.empty()) {
    const DepthComplexity d = measureDepthComplexity(hierarchy, readSession(command.session),
                                                     command.every, command.context);
    fmt::print(command.json ? stderr : stdout,
               "depth complexity: {:.2f} layers per covered pixel, mean of {} frames ({:.2f} to "
               "{:.2f}); {:.0f} % of the pixels are covered\n",
               d.mean, d.frames, d.min, d.max, 100.0 * d.coverage);
  }
}

}  // namespace

void addInfoCommand(CLI::App& app) {
  auto command = std::make_shared<InfoCommand>();
  CLI::App* sub = app.add_subcommand("info", "Print what a hierarchy holds");
  sub->add_option("file", command->file, "hierarchy (.hlod)")->required();
  sub->add_flag("--json", command->json,
                "every node: id, parent, children, box, error (world units), triangle count");
  sub->add_flag("--check", command->check,
                "check every checksum, and the hierarchy's invariants; exit code 1 if these are "
                "broken");
  sub->add_option("--depth-complexity", command->session,
                  "session (.json) over which to measure the layers per covered pixel, all leaves "
                  "drawn");
  sub->add_option("--every", command->every, "take every N-th frame for that")
      ->capture_default_str()
      ->check(CLI::Range(1, 1'000'000));
  sub->add_option("--context", command->context, "auto, egl or osmesa")->capture_default_str();
  sub->callback([command] { showInfo(*command); });
}

}  // namespace hlodbench
