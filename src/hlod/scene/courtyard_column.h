#pragma once

#include <cstdint>

#include "hlod/scene/courtyard_body.h"

namespace hlodbench::courtyard {

enum class ShaftStyle { kFluted, kTwisted, kDiamond, kBraided };
inline constexpr int kShaftStyles = 4;

struct ColumnSpec {
  double height = 2.1;   // of base, shaft and capital together
  double radius = 0.12;  // of the shaft at its foot
  ShaftStyle style = ShaftStyle::kFluted;
  std::uint64_t seed = 1;  // decides the capital's leaves and the sense of the twist
};

// A column standing on y = 0: square plinth, moulded base, carved shaft, leaf capital, square
// abacus; one closed surface.
Body makeColumn(const ColumnSpec& spec, double detail);

}  // namespace hlodbench::courtyard
