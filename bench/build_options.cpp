#include "build_options.h"

#include <fmt/format.h>

#include <charconv>
#include <string_view>

#include "choice.h"
#include "hlod/core/error.h"

namespace hlodbench {

std::uint64_t parseMemory(const std::string& option, const std::string& text) {
  constexpr std::string_view kUnits = "KMG";
  std::uint64_t number = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  unsigned shift = 0;
  bool good = error == std::errc{} && number > 0 && end - rest <= 1;
  if (good && rest != end) {
    const std::size_t unit = kUnits.find(*rest);
    good = unit != std::string_view::npos;
    shift = good ? 10 * (static_cast<unsigned>(unit) + 1) : 0;
  }
  if (!good || number > (std::uint64_t{1} << (50 - shift)))
    throw InputError(fmt::format(
        "{}: expected a size in bytes, K, M or G, such as 2G, found \"{}\"", option, text));
  return number << shift;
}

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
          [&options](const std::string& text) { options.memory = parseMemory("--memory", text); },
          "build in about this much memory, in bytes, K, M or G (of 1024), such as 2G; triangles "
          "then wait in an unnamed temporary file of 40 bytes a triangle in the output's folder; "
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
