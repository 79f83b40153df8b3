#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace hlodbench {

// A number of bytes as people write it: digits, and K, M or G for powers of 1024. Nothing for
// anything else, 0, or what is too large.
std::optional<std::uint64_t> parseByteSize(const std::string& text);

}  // namespace hlodbench
