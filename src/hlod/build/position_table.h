#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace hlodbench {

// Numbers vertices, unique by exact position and object, in the order in which they come.
class PositionTable {
 public:
  // expected: about how many vertices there will be.
  explicit PositionTable(std::size_t expected) : slots_(std::bit_ceil(expected * 2 + 16), kNone) {}

  // The vertex's number. It is new when it equals the number of vertices before; such are added to
  // the two lists. seams: gets a 1 for every vertex whose position another object has, too.
  std::uint32_t add(const glm::vec3& position, std::uint32_t object,
                    std::vector<glm::vec3>& positions, std::vector<std::uint32_t>& objects,
                    std::vector<std::uint8_t>& seams) {
    const std::size_t mask = slots_.size() - 1;
    bool seam = false;
    std::size_t slot = hash(position) & mask;
    for (; slots_[slot] != kNone; slot = (slot + 1) & mask) {
      const std::uint32_t vertex = slots_[slot];
      if (positions[vertex] != position) continue;
      if (objects[vertex] == object) return vertex;
      seams[vertex] = 1;
      seam = true;
    }
    const auto vertex = static_cast<std::uint32_t>(positions.size());
    slots_[slot] = vertex;
    positions.push_back(position);
    objects.push_back(object);
    seams.push_back(seam ? 1 : 0);
    if (positions.size() * 2 > slots_.size()) grow(positions);
    return vertex;
  }

  // The number of a vertex that was added.
  [[nodiscard]] std::uint32_t find(const glm::vec3& position, std::uint32_t object,
                                   const std::vector<glm::vec3>& positions,
                                   const std::vector<std::uint32_t>& objects) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = hash(position) & mask;
    while (positions[slots_[slot]] != position || objects[slots_[slot]] != object)
      slot = (slot + 1) & mask;
    return slots_[slot];
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;

  static std::uint64_t hash(const glm::vec3& p) {
    std::uint64_t h = std::bit_cast<std::uint32_t>(p.x);
    h = h * 0x9e3779b97f4a7c15u + std::bit_cast<std::uint32_t>(p.y);
    h = (h ^ (h >> 29)) * 0xbf58476d1ce4e5b9u + std::bit_cast<std::uint32_t>(p.z);
    h = (h ^ (h >> 32)) * 0x94d049bb133111ebu;
    return h ^ (h >> 31);
  }

  void grow(const std::vector<glm::vec3>& positions) {
    slots_.assign(slots_.size() * 2, kNone);
    const std::size_t mask = slots_.size() - 1;
    for (std::uint32_t vertex = 0; vertex < positions.size(); ++vertex) {
      std::size_t slot = hash(positions[vertex]) & mask;
      while (slots_[slot] != kNone) slot = (slot + 1) & mask;
      slots_[slot] = vertex;
    }
  }

  std::vector<std::uint32_t> slots_;  // a power of two, at most half full
};

}  // namespace hlodbench
