#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "hlod/query/query_source.h"

namespace hlodbench {

// When query results are there (option --latency).
struct Latency {
  enum class Kind { kGl, kFrames, kDraws };
  Kind kind = Kind::kGl;
  std::uint32_t count = 0;

  [[nodiscard]] std::string toString() const;
};

// "gl", "frames:N" or "draws:N" with N from 0 to 1000000; throws InputError otherwise.
Latency parseLatency(std::string_view text);

// The source itself, or one of fixed latency around it.
std::unique_ptr<QuerySource> wrapQuerySource(QuerySource& gl, const Latency& latency,
                                             std::size_t nodeCount);

}  // namespace hlodbench
