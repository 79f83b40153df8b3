#include <fmt/format.h>

#include <memory>

#include "build_options.h"
#include "commands.h"
#include "hierarchy_store.h"
#include "interrupt.h"
#include "preset.h"

namespace hlodbench {
namespace {

struct BuildCommand {
  std::filesystem::path scene, output;
  BuildOptions options;
  Preset preset = Preset::kPaper;
};

void printReport(const BuildReport& r) {
  if (r.smallPartSize > 0.0)
    fmt::print(
        stderr,
        "the scene is of small parts, {:.0f} triangles on the average: nodes of {} triangles, "
        "simplified by {}\n",
        r.smallPartSize, kSmallPart, kDefaultSimplifier);
  fmt::print(stderr, "built {} nodes ({} leaves, {} levels) in {:.1f} s\n", r.nodes, r.leaves,
             r.levels, r.totalSeconds);
  fmt::print(stderr,
             "  {} of {} inner nodes keep more triangles than the limit because their borders are "
             "locked; the largest node has {}\n",
             r.nodesAboveLimit, r.nodes - r.leaves, r.largestNode);
  const SimplifierStats& s = r.simplifier;
  if (s.splitVertices + s.flippedFaces + s.degenerateTriangles + s.duplicateTriangles > 0)
    fmt::print(stderr,
               "  repaired in inner nodes: {} vertices split, {} faces turned, {} degenerate and "
               "{} duplicate faces left out (leaves keep every triangle)\n",
               s.splitVertices, s.flippedFaces, s.degenerateTriangles, s.duplicateTriangles);
}

void build(const BuildCommand& command) {
  catchInterrupts();
  const StoredHierarchy stored = buildOrReuse(command.scene, command.output, command.options);
  if (stored.report) {
    printReport(*stored.report);
    fmt::print(stderr, "wrote {}\n", command.output.string());
  } else {
    fmt::print(stderr, "{} is up to date\n", command.output.string());
  }
}

}  // namespace

void addBuildCommand(CLI::App& app) {
  auto command = std::make_shared<BuildCommand>();
  CLI::App* sub = app.add_subcommand(
      "build", "Build the hierarchy of a scene, unless the file holds it already");
  sub->add_option("scene", command->scene, "scene file (.json) or mesh (.ply, .obj, .off, .stl)")
      ->required();
  sub->add_option("-o,--output", command->output, "hierarchy to write (.hlod)")->required();
  addPresetOption(*sub, command->preset);
  addBuildOptions(*sub, command->options);
  sub->callback([command, sub] {
    applyPreset(command->preset, *sub, command->options);
    build(*command);
  });
}

}  // namespace hlodbench
