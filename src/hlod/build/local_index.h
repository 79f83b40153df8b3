#pragma once

#include <bit>
#include <cstdint>
#include <vector>

namespace hlodbench {

// Numbers a node's vertices 0, 1, 2... in the order in which they are first asked for. Kept between
// nodes, so that its memory is taken once.
class LocalIndex {
 public:
  LocalIndex() : slots_(1024) {}

  // Forgets every vertex.
  void reset() {
    order_.clear();
    ++round_;
    if (round_ == 0) {
      slots_.assign(slots_.size(), Slot{});
      round_ = 1;
    }
  }

  // The local number of a vertex; gives it the next one when it is new.
  std::uint32_t add(std::uint32_t vertex) {
    Slot& slot = find(vertex);
    if (slot.round == round_) return slot.local;
    const auto local = static_cast<std::uint32_t>(order_.size());
    slot = {vertex, local, round_};
    order_.push_back(vertex);
    if (order_.size() * 2 > slots_.size()) grow();
    return local;
  }

  // The vertices by local number.
  [[nodiscard]] const std::vector<std::uint32_t>& vertices() const { return order_; }

 private:
  struct Slot {
    std::uint32_t vertex = 0;
    std::uint32_t local = 0;
    std::uint32_t round = 0;  // the slot is empty unless this is the current round
  };

  Slot& find(std::uint32_t vertex) {
    const std::size_t mask = slots_.size() - 1;
    std::size_t i = (vertex * 0x9e3779b1u) & mask;
    while (slots_[i].round == round_ && slots_[i].vertex != vertex) i = (i + 1) & mask;
    return slots_[i];
  }

  void grow() {
    slots_.assign(slots_.size() * 2, Slot{});
    for (std::uint32_t local = 0; local < order_.size(); ++local)
      find(order_[local]) = {order_[local], local, round_};
  }

  std::vector<Slot> slots_;  // a power of two, at most half full
  std::vector<std::uint32_t> order_;
  std::uint32_t round_ = 1;
};

}  // namespace hlodbench
