#pragma once

#include <CLI/CLI.hpp>

#include "traversals/options.h"

namespace hlodbench {

// Adds --tau, --s, --t, --exponent, --stale-children, --zero-pixels and --simp.
void addTraversalOptions(CLI::App& command, TraversalOptions& options);

}  // namespace hlodbench
