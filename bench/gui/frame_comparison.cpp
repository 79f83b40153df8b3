#include "gui/frame_comparison.h"

#include <fmt/format.h>

#include <algorithm>

#include "hlod/core/error.h"
#include "result_folder.h"
#include "session_writer.h"

namespace hlodbench {
namespace {

constexpr const char* kPython = "/usr/bin/python3";

std::filesystem::path findProgram() {
  return std::filesystem::read_symlink("/proc/self/exe");
}

// scripts/report.py of the source tree that the program was built in; empty where there is none.
std::filesystem::path findReportScript() {
  for (auto folder = findProgram().parent_path(); folder != folder.parent_path();
       folder = folder.parent_path())
    if (auto script = folder / "scripts" / "report.py"; std::filesystem::exists(script))
      return script;
  return {};
}

void addTraversal(const TraversalOptions& options, std::vector<std::string>& arguments) {
  for (const auto& [name, value] :
       {std::pair("--tau", options.tau), std::pair("--s", options.bias.s),
        std::pair("--t", options.bias.t), std::pair("--exponent", options.bias.exponent)})
    arguments.insert(arguments.end(), {name, fmt::format("{}", value)});
  if (options.staleChildren == StaleChildren::kLiteral)
    arguments.insert(arguments.end(), {"--stale-children", "literal"});
  if (options.zeroPixels == ZeroPixels::kLiteral)
    arguments.insert(arguments.end(), {"--zero-pixels", "literal"});
  if (options.simpEstimate == SimpEstimate::kRunningMean)
    arguments.insert(arguments.end(), {"--simp", "mean"});
}

std::vector<std::string> makeRunArguments(const ComparisonInputs& inputs,
                                          const std::filesystem::path& session,
                                          const std::filesystem::path& out) {
  std::vector<std::string> strategies{"bool", "sw-b"};
  for (const PaneSettings& pane : inputs.panes)
    if (std::count(strategies.begin(), strategies.end(), pane.strategy) == 0)
      strategies.push_back(pane.strategy);
  const std::size_t last = inputs.session.poses.size() - 1;
  std::vector<std::string> arguments{findProgram().string(),
                                     "run",
                                     "--scene",
                                     inputs.hierarchy.string(),
                                     "--session",
                                     session.string(),
                                     "--out",
                                     out.string(),
                                     "--strategy",
                                     fmt::format("{}", fmt::join(strategies, ",")),
                                     "--latency",
                                     inputs.panes[0].latency.toString(),
                                     "--warm-up",
                                     std::to_string(last),
                                     "--images",
                                     fmt::format("{},", last),
                                     "--overlay",
                                     "bias,level,rarn"};
  addTraversal(inputs.panes[0].traversal, arguments);
  for (const auto& plugin : inputs.plugins)
    arguments.insert(arguments.end(), {"--plugin", plugin.string()});
  for (const std::string& setting : inputs.settings)
    arguments.insert(arguments.end(), {"--set", setting});
  return arguments;
}

}  // namespace

FrameComparison::FrameComparison(const ComparisonInputs& inputs, std::filesystem::path folder)
    : folder_(std::move(folder)), log_(folder_ / "log.txt") {
  makeResultFolder(folder_);
  const std::filesystem::path session = folder_ / "frame.session.json";
  writeSession(session, inputs.session);
  run_.emplace(makeRunArguments(inputs, session, folder_ / "run"), log_);
  message_ = fmt::format("comparing this frame in {}", folder_.string());
}

bool FrameComparison::poll() {
  if (ended_) return false;
  if (report_) {
    const auto code = report_->poll();
    if (!code) return false;
    if (*code != 0)
      return end(true, fmt::format("the report of {} failed, see {}", (folder_ / "run").string(),
                                   log_.string()));
    return end(false, fmt::format("open {} in a browser", (folder_ / "report.html").string()));
  }
  const auto code = run_->poll();
  if (!code) return false;
  if (*code != 0)
    return end(true, fmt::format("comparing the frame failed, see {}", log_.string()));
  const std::filesystem::path script = findReportScript();
  if (script.empty())
    return end(false, fmt::format("compared in {}; scripts/report.py makes a report of it",
                                  (folder_ / "run").string()));
  report_.emplace(std::vector<std::string>{kPython, script.string(), (folder_ / "run").string(),
                                           "--out", (folder_ / "report.html").string(),
                                           "--hlodbench", findProgram().string()},
                  log_);
  return false;
}

bool FrameComparison::end(bool failed, std::string message) {
  ended_ = true;
  failed_ = failed;
  message_ = std::move(message);
  return true;
}

}  // namespace hlodbench
