#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace hlodbench {

// The number of threads to work with: `wanted`, or one a core when it is 0. At least 1.
inline unsigned resolveThreads(unsigned wanted) {
  if (wanted != 0) return wanted;
  const unsigned cores = std::thread::hardware_concurrency();
  return cores == 0 ? 1 : cores;
}

// Calls body(index, worker) once for every index in [0, count), on `threads` threads of which the
// calling one is worker 0; worker < threads, for scratch memory of its own. Indices are handed out
// in increasing order, one at a time. `report`, where given, is called with the number of finished
// indices and from the calling thread only. The first exception thrown by body or report stops the
// work and is thrown again here, after every thread has ended.
template <typename Body>
void parallelFor(std::size_t count, unsigned threads, Body&& body,
                 const std::function<void(std::size_t)>& report = {}) {
  std::atomic<std::size_t> next{0};
  std::atomic<std::size_t> finished{0};
  std::atomic<bool> failed{false};
  std::mutex mutex;
  std::exception_ptr failure;
  const auto work = [&](unsigned worker) {
    try {
      while (!failed.load(std::memory_order_relaxed)) {
        const std::size_t index = next.fetch_add(1, std::memory_order_relaxed);
        if (index >= count) break;
        body(index, worker);
        const std::size_t done = finished.fetch_add(1, std::memory_order_relaxed) + 1;
        if (worker == 0 && report) report(done);
      }
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!failure) failure = std::current_exception();
      failed = true;
    }
  };
  {
    std::vector<std::jthread> others;
    for (unsigned worker = 1; worker < threads && worker < count; ++worker)
      others.emplace_back(work, worker);
    work(0);
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace hlodbench
