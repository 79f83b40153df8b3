#pragma once

#include <optional>
#include <string>
#include <vector>

namespace hlodbench {

// A line of CSV (RFC 4180, but it ends in "\n"): fields are quoted where they need it.
std::string formatCsvLine(const std::vector<std::string>& fields);

// The shortest text that reads back to the same number; nothing for an absent one.
std::string formatCsvNumber(const std::optional<double>& value);

}  // namespace hlodbench
