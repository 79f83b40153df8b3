#include "build_options.h"

#include <fmt/format.h>

#include "hlod/core/error.h"

namespace hlodbench {

void addBuildOptions(CLI::App& command, BuildOptions& options) {
  command
      .add_option("--max-triangles", options.maxTriangles,
                  "split a node above this, and simplify to it; triangles")
      ->capture_default_str()
      ->check(CLI::Range(16u, 1'000'000u));
  command.add_option("--simplifier", options.simplifier, "openmesh, or meshopt where built in")
      ->capture_default_str();
  command
      .add_option("--error-samples", options.errorSamples,
                  "face points a node from which its error is measured, besides its vertices")
      ->capture_default_str()
      ->check(CLI::Range(100u, 10'000'000u));
  command.add_option("--threads", options.threads, "threads for building; 0: one a core")
      ->capture_default_str()
      ->check(CLI::Range(0u, 1024u));
}

void refuseBuildOptions(const CLI::App& command, const std::filesystem::path& scene) {
  if (scene.extension() != ".hlod") return;
  for (const char* option : {"--max-triangles", "--simplifier", "--error-samples", "--threads"})
    if (command.count(option) > 0)
      throw InputError(
          fmt::format("{}: expected a scene or mesh file to build from, found {}, which is built",
                      option, scene.string()));
}

}  // namespace hlodbench
