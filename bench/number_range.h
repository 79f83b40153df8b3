#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <string>

namespace hlodbench {

// Accepts the numbers from least to most. CLI::Range lets NaN through, as no comparison with it
// holds.
inline CLI::Validator makeNumberRange(double least, double most) {
  return {[=](std::string& text) {
            double value = 0.0;
            const bool isNumber = CLI::detail::lexical_cast(text, value);
            if (isNumber && value >= least && value <= most) return std::string();
            return fmt::format("expected a number from {:.16g} to {:.16g}, found '{}'", least, most,
                               text);
          },
          ""};
}

}  // namespace hlodbench
