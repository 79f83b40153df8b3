#include "compare_differences.h"

#include <fmt/format.h>

#include <algorithm>

namespace hlodbench {
namespace {

std::string toText(const nlohmann::json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

std::string optionText(const RunResult& run, const std::string& key) {
  const auto found = run.options.find(key);
  return found == run.options.end() ? "not stated" : toText(*found);
}

class Finder {
 public:
  Finder(const RunResult& a, const RunResult& b, const std::set<std::string>& allowed)
      : a_(a), b_(b), allowed_(allowed) {}

  RunDifferences find() {
    found_.sameSession = a_.session.hash == b_.session.hash;
    need("scene", "scene", a_.scene.hash, b_.scene.hash, fmt::format(" ({})", a_.scene.name),
         fmt::format(" ({})", b_.scene.name));
    need("session", "session", a_.session.hash, b_.session.hash,
         fmt::format(" ({})", a_.session.name), fmt::format(" ({})", b_.session.name));
    need("size", "viewport size", optionText(a_, "viewport"), optionText(b_, "viewport"));
    need("tau", "tau", optionText(a_, "tau"), optionText(b_, "tau"));
    compareMachines();
    compareOptions();
    return std::move(found_);
  }

 private:
  void need(const char* allowance, const char* what, const std::string& a, const std::string& b,
            const std::string& ofA = "", const std::string& ofB = "") {
    if (a == b) return;
    const std::string line = fmt::format("{} differs: A {}{}, B {}{}", what, a, ofA, b, ofB);
    if (allowed_.count(allowance))
      found_.notes.push_back(line + " (allowed)");
    else
      found_.refusals.push_back(
          fmt::format("{} (--allow {} compares all the same)", line, allowance));
  }

  void note(const std::string& what, const std::string& a, const std::string& b) {
    if (a != b) found_.notes.push_back(fmt::format("{}: A {}, B {}", what, a, b));
  }

  // Of what times depend on.
  void needForTimes(const std::string& what, const std::string& a, const std::string& b) {
    if (a == b) return;
    note(what, a, b);
    machine_ += (machine_.empty() ? "" : ", ") + what;
  }

  void compareMachines() {
    const Environment& a = a_.environment;
    const Environment& b = b_.environment;
    const std::string unknown = "unknown";
    needForTimes("processor", a.cpuModel.value_or(unknown), b.cpuModel.value_or(unknown));
    needForTimes("processor cores", fmt::format("{}", a.cpuCores), fmt::format("{}", b.cpuCores));
    needForTimes("OpenGL vendor", a.gl.vendor, b.gl.vendor);
    needForTimes("OpenGL renderer", a.gl.renderer, b.gl.renderer);
    needForTimes("OpenGL version", a.gl.version, b.gl.version);
    needForTimes("compiler", a.compiler, b.compiler);
    needForTimes("build type", a.buildType, b.buildType);
    if (!machine_.empty() && !allowed_.count("machine"))
      found_.timesObstacle = fmt::format(
          "times are not compared: another {} (--allow machine compares all the same)", machine_);
    note("program", a.program, b.program);
    note("revision", a.gitRevision.value_or(unknown), b.gitRevision.value_or(unknown));
    note("governor", a.cpuGovernor.value_or(unknown), b.cpuGovernor.value_or(unknown));
    note("kernel", a.kernel, b.kernel);
  }

  void compareOptions() {
    note("frames in flight", fmt::format("{}", a_.framesInFlight),
         fmt::format("{}", b_.framesInFlight));
    note("warm-up frames", fmt::format("{}", a_.warmUpFrames), fmt::format("{}", b_.warmUpFrames));
    // those above, and those that change nothing of what is compared
    const std::set<std::string> known{"viewport", "tau",      "strategies", "repetitions",
                                      "images",   "overlays", "seed"};
    std::set<std::string> keys;
    for (const RunResult* run : {&a_, &b_})
      for (const auto& [key, value] : run->options.items())
        if (!known.count(key)) keys.insert(key);
    for (const std::string& key : keys)
      note("option " + key, optionText(a_, key), optionText(b_, key));
  }

  const RunResult& a_;
  const RunResult& b_;
  const std::set<std::string>& allowed_;
  std::string machine_;  // what times depend on and differs
  RunDifferences found_;
};

}  // namespace

const std::vector<std::string>& listAllowances() {
  static const std::vector<std::string> names{"scene", "session", "size", "tau", "machine"};
  return names;
}

RunDifferences findDifferences(const RunResult& a, const RunResult& b,
                               const std::set<std::string>& allowed) {
  return Finder(a, b, allowed).find();
}

std::optional<std::string> findCountObstacle(const RunResult& run) {
  const std::string latency = optionText(run, "latency");
  if (latency.rfind("draws:", 0) != 0 && latency.rfind("frames:", 0) != 0)
    return fmt::format("latency {}", latency);
  const auto memory = run.options.find("gpu_memory");
  if (memory != run.options.end() && !memory->is_null())
    return fmt::format("gpu_memory {}", toText(*memory));
  return std::nullopt;
}

}  // namespace hlodbench
