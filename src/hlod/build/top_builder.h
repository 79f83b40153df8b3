#pragma once

#include <vector>

#include "hlod/build/chunk_builder.h"
#include "hlod/build/chunk_plan.h"

namespace hlodbench {

// Builds the nodes above the chunks' roots from the LODs of these, which are used up. workers: one
// a thread. Returns one node a TopNode, those of the chunks empty: links are between these.
std::vector<BuiltNode> buildTop(const ChunkPlan& plan, std::vector<BuiltChunk>& chunks,
                                const ChunkContext& context, std::vector<LodWorker>& workers,
                                std::vector<std::uint8_t>& turned);

// Puts all nodes into one tree, in breadth-first order, and says which are consistently wound.
// top, turned: what buildTop() gave.
BuiltTree joinTree(const ChunkPlan& plan, const std::vector<BuiltNode>& top,
                   const std::vector<std::uint8_t>& turned, const std::vector<BuiltChunk>& chunks,
                   const WindingCheck& winding);

}  // namespace hlodbench
