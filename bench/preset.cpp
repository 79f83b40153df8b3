#include "preset.h"

#include <algorithm>

#include "choice.h"

namespace hlodbench {

void addPresetOption(CLI::App& command, Preset& preset) {
  addChoice<Preset>(command, "--preset", preset,
                    {{"paper", Preset::kPaper}, {"best", Preset::kBest}},
                    "defaults of the other options: as in the paper, or what gives a picture of "
                    "equal quality with least work; options given besides win");
}

void applyPreset(Preset preset, const CLI::App& command, BuildOptions& options) {
  if (preset != Preset::kBest) return;
  options.adaptToParts =
      command.count("--max-triangles") == 0 && command.count("--simplifier") == 0;
  if (command.count("--max-triangles") == 0) options.maxTriangles = 16000;
  if (command.count("--error") == 0) options.error = ErrorMeasure::kRms;
  if (command.count("--normals") == 0) options.normals = LodNormals::kSmoothed;
  const std::vector<std::string> simplifiers = simplifierNames();
  if (command.count("--simplifier") == 0 &&
      std::find(simplifiers.begin(), simplifiers.end(), "meshopt") != simplifiers.end())
    options.simplifier = "meshopt";
}

}  // namespace hlodbench
