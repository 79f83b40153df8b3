#include "viewport_size.h"

#include <fmt/format.h>

#include <charconv>

#include "hlod/core/error.h"

namespace hlodbench {

void applySize(const std::string& size, Lens& lens) {
  constexpr int kMaxViewport = 16384;  // what OpenGL implementations commonly allow
  if (size.empty()) return;
  const char* end = size.data() + size.size();
  const auto width = std::from_chars(size.data(), end, lens.width);
  const bool hasX = width.ec == std::errc() && width.ptr != end && *width.ptr == 'x';
  const auto height = std::from_chars(hasX ? width.ptr + 1 : end, end, lens.height);
  if (!hasX || height.ec != std::errc() || height.ptr != end || lens.width < 1 || lens.height < 1 ||
      lens.width > kMaxViewport || lens.height > kMaxViewport)
    throw InputError(
        fmt::format("--size: expected WIDTHxHEIGHT, each 1 to {}, found '{}'", kMaxViewport, size));
}

}  // namespace hlodbench
