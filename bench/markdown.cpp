#include "markdown.h"

#include <algorithm>

namespace hlodbench {
namespace {

// Columns a terminal takes: code points, that is bytes which do not continue one.
std::size_t computeWidth(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
  }));
}

}  // namespace

std::string replaceAll(std::string text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != text.npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

std::string escapeMarkdown(std::string text) {
  text = replaceAll(replaceAll(std::move(text), "\n", " "), "|", "\\|");
  return text.rfind("* ", 0) == 0 ? "\\" + text : text;
}

std::string formatMarkdownTable(const std::vector<std::string>& header,
                                const std::vector<std::vector<std::string>>& rows,
                                std::string_view alignment) {
  std::vector<std::vector<std::string>> lines{header};
  lines.insert(lines.end(), rows.begin(), rows.end());
  std::vector<std::size_t> widths(header.size(), 3);
  for (auto& line : lines)
    for (std::size_t i = 0; i < line.size(); ++i) {
      line[i] = escapeMarkdown(line[i]);
      widths[i] = std::max(widths[i], computeWidth(line[i]));
    }
  std::string out;
  for (std::size_t row = 0; row < lines.size(); ++row) {
    for (std::size_t i = 0; i < widths.size(); ++i) {
      const std::string pad(widths[i] - computeWidth(lines[row][i]), ' ');
      out += "| " + (alignment[i] == 'r' ? pad + lines[row][i] : lines[row][i] + pad) + " ";
    }
    out += "|\n";
    if (row > 0) continue;
    for (std::size_t i = 0; i < widths.size(); ++i)
      out += alignment[i] == 'r' ? "| " + std::string(widths[i] - 1, '-') + ": "
                                 : "| " + std::string(widths[i], '-') + " ";
    out += "|\n";
  }
  return out;
}

}  // namespace hlodbench
