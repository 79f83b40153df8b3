#include "metrics/environment.h"

#include <sys/utsname.h>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <chrono>
#include <fstream>
#include <sstream>
#include <thread>

#include "metrics/build_info.h"

namespace hlodbench {
namespace {

std::string trim(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r\n";
  const std::size_t begin = text.find_first_not_of(kSpace);
  if (begin == text.npos) return {};
  return std::string(text.substr(begin, text.find_last_not_of(kSpace) - begin + 1));
}

std::optional<std::string> readFirstLine(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::string line;
  if (!std::getline(in, line) || trim(line).empty()) return std::nullopt;
  return trim(line);
}

// The value of the first line "key<separator>value".
std::optional<std::string> readValue(const std::filesystem::path& path, std::string_view key,
                                     char separator) {
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    const std::size_t at = line.find(separator);
    if (at == line.npos || trim(std::string_view(line).substr(0, at)) != key) continue;
    std::string value = trim(std::string_view(line).substr(at + 1));
    if (value.size() >= 2 && value.front() == '"' && value.back() == '"')
      value = value.substr(1, value.size() - 2);
    if (!value.empty()) return value;
  }
  return std::nullopt;
}

std::optional<std::array<double, 3>> readLoadAverage(const std::filesystem::path& path) {
  const std::optional<std::string> line = readFirstLine(path);
  if (!line) return std::nullopt;
  // from_chars, not a stream: the load must read the same in a locale with a decimal comma.
  std::array<double, 3> load{};
  const char* at = line->data();
  const char* end = at + line->size();
  for (double& value : load) {
    while (at != end && *at == ' ') ++at;
    const auto [stop, error] = std::from_chars(at, end, value);
    if (error != std::errc()) return std::nullopt;
    at = stop;
  }
  return load;
}

std::string readKernel() {
  utsname name{};
  if (uname(&name) != 0) return "unknown";
  return fmt::format("{} {} {}", name.sysname, name.release, name.machine);
}

std::string formatTimeUtc(std::chrono::system_clock::time_point time) {
  const auto seconds = std::chrono::floor<std::chrono::seconds>(time);
  const auto days = std::chrono::floor<std::chrono::days>(seconds);
  const std::chrono::year_month_day date(days);
  const std::chrono::hh_mm_ss clock(seconds - days);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", static_cast<int>(date.year()),
                     static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                     clock.hours().count(), clock.minutes().count(), clock.seconds().count());
}

std::string toLower(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

bool startsWith(std::string_view text, std::string_view begin) {
  return text.substr(0, begin.size()) == begin;
}

}  // namespace

Environment readEnvironment(std::vector<std::string> arguments, GlInfo gl,
                            const std::filesystem::path& root) {
  Environment environment;
  environment.program = kProgramVersion;
  if (!std::string_view(kGitRevision).empty()) environment.gitRevision = kGitRevision;
  environment.compiler = kCompiler;
  environment.buildType = kBuildType;
  environment.cpuModel = readValue(root / "proc/cpuinfo", "model name", ':');
  environment.cpuCores = static_cast<int>(std::thread::hardware_concurrency());
  environment.cpuGovernor =
      readFirstLine(root / "sys/devices/system/cpu/cpu0/cpufreq/scaling_governor");
  environment.distribution = readValue(root / "etc/os-release", "PRETTY_NAME", '=');
  environment.kernel = readKernel();
  environment.loadAverage = readLoadAverage(root / "proc/loadavg");
  environment.timeUtc = formatTimeUtc(std::chrono::system_clock::now());
  environment.arguments = std::move(arguments);
  environment.gl = std::move(gl);
  return environment;
}

bool isSoftwareRenderer(std::string_view glRenderer) {
  const std::string renderer = toLower(glRenderer);
  if (startsWith(renderer, "swr")) return true;  // "SWR (LLVM ...)"; inside a word it means nothing
  for (const std::string_view name :
       {"llvmpipe", "softpipe", "swrast", "swiftshader", "software rasterizer"})
    if (renderer.find(name) != renderer.npos) return true;
  return false;
}

std::vector<std::string> computeWarnings(const Environment& environment) {
  std::vector<std::string> warnings;
  const std::string build = toLower(environment.buildType);
  if (!startsWith(build, "rel") && !startsWith(build, "minsizerel"))
    warnings.push_back(
        fmt::format("the build type is \"{}\": timings are not those of an optimised "
                    "build; use CMAKE_BUILD_TYPE=Release",
                    environment.buildType));
  if (build.find("sanitizers") != build.npos)
    warnings.push_back("built with sanitizers: timings are several times too long");
  if (isSoftwareRenderer(environment.gl.renderer))
    warnings.push_back(
        fmt::format("software rasteriser ({}): node counts are valid, frame times "
                    "say nothing about a GPU",
                    environment.gl.renderer));
  if (environment.cpuGovernor && *environment.cpuGovernor != "performance")
    warnings.push_back(
        fmt::format("CPU frequency governor is \"{}\", not \"performance\": timings "
                    "depend on the load before",
                    *environment.cpuGovernor));
  if (environment.loadAverage && environment.cpuCores > 0) {
    const double limit = std::max(1.0, 0.5 * environment.cpuCores);
    if (environment.loadAverage->front() > limit)
      warnings.push_back(
          fmt::format("load average {:.2f} on {} cores before the run: other "
                      "programs share the machine",
                      environment.loadAverage->front(), environment.cpuCores));
  }
  return warnings;
}

}  // namespace hlodbench
