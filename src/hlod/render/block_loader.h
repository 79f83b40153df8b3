#pragma once

#include <condition_variable>
#include <exception>
#include <mutex>
#include <span>
#include <thread>
#include <vector>

#include "hlod/tree/hierarchy.h"

namespace hlodbench {

// Reads and checks blocks of a mapped hierarchy in a thread of its own, so that nobody who draws
// waits for a disk: afterwards the block is in the system's memory.
class BlockLoader {
 public:
  // The hierarchy must outlive the loader.
  explicit BlockLoader(const Hierarchy& hierarchy);
  ~BlockLoader();
  BlockLoader(const BlockLoader&) = delete;
  BlockLoader& operator=(const BlockLoader&) = delete;

  // Asks for nodes, to be read in this order, after those asked for before. A node may be asked for
  // again only when it has been taken.
  void request(std::span<const NodeId> nodes);
  // Adds the nodes that are there to `ready`. Throws InputError when a block was damaged.
  void takeReady(std::vector<NodeId>& ready);

 private:
  void work();

  const Hierarchy& hierarchy_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::vector<NodeId> requested_, ready_;  // guarded, as the next two
  std::exception_ptr failure_;
  bool isEnding_ = false;
  std::vector<NodeId> work_;  // of the thread
  std::thread thread_;        // after everything that it uses
};

}  // namespace hlodbench
