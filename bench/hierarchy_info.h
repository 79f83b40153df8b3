#pragma once

#include <string>

#include "hlod/tree/hierarchy.h"
#include "hlod/tree/hlod_file.h"

namespace hlodbench {

// For people: counts, levels, triangles per node, error per level, bounds.
std::string formatSummary(const Hierarchy& hierarchy, const HlodFileInfo& info);

// {"nodes":[{"id","parent","children","min","max","error","triangles"}, ...]}: world units, numbers
// with 9 significant digits, which tell every float apart; the root's parent is null.
std::string formatNodesJson(const Hierarchy& hierarchy);

}  // namespace hlodbench
