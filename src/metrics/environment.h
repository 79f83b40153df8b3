#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hlodbench {

// What the OpenGL driver says of itself (GL_VENDOR, GL_RENDERER, GL_VERSION). Empty without a
// context: a node-count run on scripted queries needs none.
struct GlInfo {
  std::string vendor;
  std::string renderer;
  std::string version;

  bool operator==(const GlInfo&) const = default;
};

// Where, when and with what a run was measured. What the system does not tell is absent.
struct Environment {
  std::string program;                     // "hlodbench 0.1.0"
  std::optional<std::string> gitRevision;  // of the sources; "-dirty" after it for local changes
  std::string compiler;                    // "GCC 12.2.0"
  std::string buildType;                   // CMAKE_BUILD_TYPE, "+sanitizers" after it if so built
  std::optional<std::string> cpuModel;
  int cpuCores = 0;                        // logical processors of the machine; 0: unknown
  std::optional<std::string> cpuGovernor;  // "performance", "schedutil", ...
  std::optional<std::string> distribution;
  std::string kernel;                                // "Linux 6.1.0-13-amd64 x86_64"
  std::optional<std::array<double, 3>> loadAverage;  // over 1, 5 and 15 minutes
  std::string timeUtc;                               // ISO 8601, "2026-01-31T12:00:00Z"
  std::vector<std::string> arguments;                // the command line, program name first
  GlInfo gl;

  bool operator==(const Environment&) const = default;
};

// Reads the environment now. `root` stands before /proc, /sys and /etc, for tests.
// Never throws for what cannot be read: that stays absent.
Environment readEnvironment(std::vector<std::string> arguments, GlInfo gl,
                            const std::filesystem::path& root = "/");

// Whether a GL_RENDERER string names a software rasteriser (llvmpipe, softpipe, swrast, SWR, ...).
bool isSoftwareRenderer(std::string_view glRenderer);

// One line for each condition under which timings say little: a build without optimisation or with
// sanitizers, a software rasteriser, a governor known not to be "performance", a load above half
// the cores (or above 1 on a machine of one). Empty when there is nothing to say.
std::vector<std::string> computeWarnings(const Environment& environment);

}  // namespace hlodbench
