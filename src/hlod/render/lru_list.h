#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hlodbench {

// Some of the numbers 0 to count - 1 in the order in which they were last used. Takes memory only
// when it is made; everything else costs the same whatever the count.
class LruList {
 public:
  static constexpr std::uint32_t kNone = 0xffffffffu;

  explicit LruList(std::size_t count) : links_(count + 1), end_(static_cast<std::uint32_t>(count)) {
    links_[end_] = {end_, end_};
  }

  [[nodiscard]] bool contains(std::uint32_t id) const { return links_[id].next != kNone; }
  // Adds the number, or makes it the one used last.
  void use(std::uint32_t id) {
    remove(id);
    const std::uint32_t last = links_[end_].previous;
    links_[id] = {last, end_};
    links_[last].next = id;
    links_[end_].previous = id;
  }
  // Does nothing when it is not there.
  void remove(std::uint32_t id) {
    if (!contains(id)) return;
    links_[links_[id].previous].next = links_[id].next;
    links_[links_[id].next].previous = links_[id].previous;
    links_[id] = {};
  }
  // The number not used for the longest time; kNone when there is none.
  [[nodiscard]] std::uint32_t oldest() const {
    return links_[end_].next == end_ ? kNone : links_[end_].next;
  }
  // The one used next after it; kNone after the one used last.
  [[nodiscard]] std::uint32_t after(std::uint32_t id) const {
    return links_[id].next == end_ ? kNone : links_[id].next;
  }

 private:
  struct Links {
    std::uint32_t previous = kNone, next = kNone;
  };
  std::vector<Links> links_;  // a ring; the last entry is its end and its beginning
  std::uint32_t end_;
};

}  // namespace hlodbench
