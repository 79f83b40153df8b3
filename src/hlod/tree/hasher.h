#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace hlodbench {

// XXH3-64 of what is added, in pieces of any size.
class Hasher {
 public:
  Hasher() : state_(XXH3_createState(), XXH3_freeState) { XXH3_64bits_reset(state_.get()); }
  void add(const void* data, std::size_t bytes) { XXH3_64bits_update(state_.get(), data, bytes); }
  [[nodiscard]] std::uint64_t digest() const { return XXH3_64bits_digest(state_.get()); }

 private:
  std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> state_;
};

// XXH3-64 of a block; what Node::geometryHash is.
inline std::uint64_t computeHash(std::span<const std::byte> bytes) {
  return XXH3_64bits(bytes.data(), bytes.size());
}

}  // namespace hlodbench
