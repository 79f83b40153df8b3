#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <mutex>
#include <vector>

#include "hlod/core/temporary_file.h"
#include "hlod/tree/hlod_file.h"
#include "hlod/tree/node_sink.h"

namespace hlodbench {

// Writes a hierarchy file whose geometry never is in memory as a whole: blocks go to an unnamed
// file in the same folder as they come, and finish() puts them into the order of the nodes, so that
// a file does not depend on who was first, and the coarse nodes, which every view needs, lie
// together. For that time the disk holds the geometry twice.
class HlodWriter final : public NodeSink {
 public:
  // Throws InputError when the folder cannot be written.
  explicit HlodWriter(std::filesystem::path path);

  // Throws InputError when the disk is full or the like.
  void addGeometry(NodeId id, std::span<const Vertex> vertices,
                   std::span<const std::uint32_t> indices) override;

  // Writes the file: hierarchy has all but the geometry, of which its nodes' offsets, counts and
  // hashes are set here. ids: the ids under which the nodes' geometry was given, by node; empty
  // when these are the nodes' own numbers. Every node must have been given. Sets info.version and
  // info.contentHash. The file appears under its name when it is whole; nothing else is left behind
  // whatever happens. Throws InputError with the path and the reason. To be called once.
  void finish(Hierarchy& hierarchy, HlodFileInfo& info, std::span<const NodeId> ids = {});

 private:
  struct Block {
    Node node;  // what describes the block
    std::uint64_t place = 0;
  };
  std::filesystem::path path_;
  TemporaryFile spill_;
  std::atomic<std::uint64_t> spilled_{0};  // bytes
  std::mutex mutex_;
  std::vector<Block> blocks_;  // by id
};

// Writes a hierarchy as a binary file (little-endian), its blocks in the order of the nodes, which
// are as they stand in it. As HlodWriter::finish().
void writeHlodFile(const std::filesystem::path& path, const Hierarchy& hierarchy,
                   HlodFileInfo& info);

}  // namespace hlodbench
