#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <utility>
#include <vector>

#include "hlod/render/renderer.h"
#include "traversals/options.h"

namespace hlodbench {

// Readings of the paper that it leaves open or that a transcription of it has wrong, to measure
// what they amount to (docs/ablations.md).

// Adds an option for each of them.
void addReadingOptions(CLI::App& sub, TraversalOptions& traversal, QueryFaces& faces);

// Those in effect, as run.json and traces store them: key and value.
std::vector<std::pair<std::string, std::string>> listReadings(const TraversalOptions& traversal,
                                                              QueryFaces faces);

}  // namespace hlodbench
