#include "hlod/render/block_loader.h"

namespace hlodbench {

BlockLoader::BlockLoader(const Hierarchy& hierarchy) : hierarchy_(hierarchy) {
  // no node is in a list twice
  for (std::vector<NodeId>* list : {&requested_, &ready_, &work_})
    list->reserve(hierarchy.nodes.size());
  thread_ = std::thread([this] { work(); });
}

BlockLoader::~BlockLoader() {
  {
    const std::lock_guard lock(mutex_);
    isEnding_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void BlockLoader::request(std::span<const NodeId> nodes) {
  if (nodes.empty()) return;
  {
    const std::lock_guard lock(mutex_);
    requested_.insert(requested_.end(), nodes.begin(), nodes.end());
  }
  wake_.notify_one();
}

void BlockLoader::takeReady(std::vector<NodeId>& ready) {
  const std::lock_guard lock(mutex_);
  if (failure_) std::rethrow_exception(failure_);
  ready.insert(ready.end(), ready_.begin(), ready_.end());
  ready_.clear();
}

void BlockLoader::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    wake_.wait(lock, [&] { return isEnding_ || !requested_.empty(); });
    if (isEnding_) return;
    std::swap(work_, requested_);
    for (const NodeId node : work_) {
      lock.unlock();
      std::exception_ptr failure;
      try {
        checkGeometryHash(hierarchy_, node);
      } catch (...) {
        failure = std::current_exception();
      }
      lock.lock();
      if (isEnding_) return;
      if (failure) failure_ = failure;
      ready_.push_back(node);
    }
    work_.clear();
  }
}

}  // namespace hlodbench
