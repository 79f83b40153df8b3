#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>

#include "hlod/render/renderer.h"

namespace hlodbench {

// Adds --gpu-memory: bytes for the geometry of nodes.
void addMemoryOption(CLI::App& command, std::uint64_t& bytes);

// Adds --faces.
void addFacesOption(CLI::App& command, FaceCulling& faces);

}  // namespace hlodbench
