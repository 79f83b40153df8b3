#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>

namespace hlodbench {

// Uniform indices below `count` (at least 1), from std::mt19937_64, whose output the C++ standard
// fixes. Values above the largest multiple of count are drawn again, so that no index is favoured;
// std::uniform_int_distribution differs between standard libraries.
class IndexDrawer {
 public:
  IndexDrawer(std::uint64_t seed, std::size_t count)
      : engine_(seed), count_(count), usable_(kMax - kMax % count) {}

  std::size_t draw() {
    std::uint64_t value = engine_();
    while (value >= usable_) value = engine_();
    return static_cast<std::size_t>(value % count_);
  }

 private:
  static constexpr std::uint64_t kMax = std::numeric_limits<std::uint64_t>::max();

  std::mt19937_64 engine_;
  std::uint64_t count_, usable_;
};

}  // namespace hlodbench
