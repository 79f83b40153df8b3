#include "byte_size.h"

#include <charconv>

namespace hlodbench {

std::optional<std::uint64_t> parseByteSize(const std::string& text) {
  std::uint64_t number = 0;
  const char* const end = text.data() + text.size();
  const auto [at, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || number == 0 || end - at > 1) return std::nullopt;
  const char unit = at == end ? '\0' : *at;
  const int shift = unit == '\0' ? 0 : unit == 'K' ? 10 : unit == 'M' ? 20 : unit == 'G' ? 30 : -1;
  // so much that it never means "unlimited" by chance
  if (shift < 0 || number > (~std::uint64_t{0} >> 1 >> shift)) return std::nullopt;
  return number << shift;
}

}  // namespace hlodbench
