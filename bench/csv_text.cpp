#include "csv_text.h"

#include <fmt/format.h>

namespace hlodbench {
namespace {

std::string escapeCsv(std::string text) {
  if (text.find_first_of(",\"\r\n") == text.npos) return text;
  for (std::size_t at = text.find('"'); at != text.npos; at = text.find('"', at + 2))
    text.insert(at, 1, '"');
  return fmt::format("\"{}\"", text);
}

}  // namespace

std::string formatCsvLine(const std::vector<std::string>& fields) {
  std::string line;
  for (std::size_t i = 0; i < fields.size(); ++i)
    line += fmt::format("{}{}", i ? "," : "", escapeCsv(fields[i]));
  return line + "\n";
}

std::string formatCsvNumber(const std::optional<double>& value) {
  return value ? fmt::format("{}", *value) : "";
}

}  // namespace hlodbench
