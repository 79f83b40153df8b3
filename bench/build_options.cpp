#include "build_options.h"

#include <fmt/format.h>

#include "byte_size.h"
#include "choice.h"
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
  addChoice<ErrorMeasure>(command, "--error", options.error,
                          {{"max", ErrorMeasure::kLargest}, {"rms", ErrorMeasure::kRms}},
                          "what a node's error is, of the distances from the original surface to "
                          "its mesh: the largest, "
                          "or the root mean square (pixels of --tau mean the same)");
  addChoice<LodNormals>(
      command, "--normals", options.normals,
      {{"original", LodNormals::kOriginal}, {"smoothed", LodNormals::kSmoothed}},
      "normals of simplified nodes: those of the original surface at their vertices, or of their "
      "own faces");
  command.add_option("--threads", options.threads, "threads for building; 0: one a core")
      ->capture_default_str()
      ->check(CLI::Range(0u, 1024u));
  command
      .add_option_function<std::string>(
          "--memory",
          [&options](const std::string& text) {
            const auto bytes = parseByteSize(text);
            if (!bytes)
              throw InputError(fmt::format(
                  "--memory: expected a size in bytes, K, M or G, such as 2G, found \"{}\"", text));
            options.memory = *bytes;
          },
          "build in about this much memory, in bytes, K, M or G (of 1024), such as 2G; triangles "
          "then wait in an unnamed temporary file of 40 bytes a triangle in the output's folder, "
          "and binary little-endian PLY files of triangles are read piece by piece; "
          "default: no limit, no file")
      ->type_name("SIZE");
}

void refuseBuildOptions(const CLI::App& command, const std::filesystem::path& scene) {
  if (scene.extension() != ".hlod") return;
  for (const char* option : {"--max-triangles", "--simplifier", "--error-samples", "--error",
                             "--normals", "--threads", "--memory"})
    if (command.count(option) > 0)
      throw InputError(
          fmt::format("{}: expected a scene or mesh file to build from, found {}, which is built",
                      option, scene.string()));
}

}  // namespace hlodbench
