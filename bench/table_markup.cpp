// The two ways to set a table for reading.

#include <fmt/format.h>

#include <algorithm>

#include "table_text.h"

namespace hlodbench {
namespace {

std::string replaceAll(std::string text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != text.npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

// Columns a terminal takes: code points, that is bytes which do not continue one.
std::size_t computeWidth(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
  }));
}

// Only what would end a cell or a line early, or start a list: in a terminal, text stays as it is.
std::string escapeMarkdown(std::string text) {
  text = replaceAll(replaceAll(std::move(text), "\n", " "), "|", "\\|");
  return text.rfind("* ", 0) == 0 ? "\\" + text : text;
}

std::string escapeLatex(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '\\':
        escaped += "\\textbackslash{}";
        break;
      case '~':
        escaped += "\\textasciitilde{}";
        break;
      case '^':
        escaped += "\\textasciicircum{}";
        break;
      case '<':
        escaped += "\\textless{}";
        break;
      case '>':
        escaped += "\\textgreater{}";
        break;
      case '|':
        escaped += "\\textbar{}";
        break;
      case '"':
        escaped += "''";
        break;
      case '\n':
        escaped += ' ';
        break;
      case '#':
      case '$':
      case '%':
      case '&':
      case '_':
      case '{':
      case '}':
        escaped += '\\';
        [[fallthrough]];
      default:
        escaped += c;
    }
  }
  return replaceAll(replaceAll(escaped, "–", "--"), "±", "$\\pm$");
}

std::string formatMarkdownTable(const TableGrid& grid) {
  std::vector<std::vector<std::string>> lines{grid.header};
  lines.insert(lines.end(), grid.rows.begin(), grid.rows.end());
  std::vector<std::size_t> widths(grid.header.size(), 3);
  for (auto& line : lines)
    for (std::size_t i = 0; i < line.size(); ++i) {
      line[i] = escapeMarkdown(line[i]);
      widths[i] = std::max(widths[i], computeWidth(line[i]));
    }
  std::string out;
  for (std::size_t row = 0; row < lines.size(); ++row) {
    for (std::size_t i = 0; i < widths.size(); ++i) {
      const std::string pad(widths[i] - computeWidth(lines[row][i]), ' ');
      const bool right = i >= kFirstNumberColumn;
      out += "| " + (right ? pad + lines[row][i] : lines[row][i] + pad) + " ";
    }
    out += "|\n";
    if (row > 0) continue;
    for (std::size_t i = 0; i < widths.size(); ++i)
      out += i >= kFirstNumberColumn ? "| " + std::string(widths[i] - 1, '-') + ": "
                                     : "| " + std::string(widths[i], '-') + " ";
    out += "|\n";
  }
  return out;
}

std::string formatLatexRow(const std::vector<std::string>& cells) {
  std::string row;
  for (const std::string& cell : cells) row += (row.empty() ? "" : " & ") + escapeLatex(cell);
  // The row before ends in two backslashes, which take a bracket or a star as their argument.
  if (!row.empty() && (row[0] == '[' || row[0] == '*')) row.insert(0, "{}");
  return row + " \\\\\n";
}

std::string formatLatexTabular(const TableGrid& grid) {
  std::string out = "\\begin{tabular}{ll" +
                    std::string(grid.header.size() - kFirstNumberColumn, 'r') + "}\n\\toprule\n" +
                    formatLatexRow(grid.header);
  for (std::size_t row = 0; row < grid.rows.size(); ++row) {
    if (row == 0)
      out += "\\midrule\n";
    else if (std::count(grid.groupStarts.begin(), grid.groupStarts.end(), row) > 0)
      out += "\\addlinespace\n";
    out += formatLatexRow(grid.rows[row]);
  }
  return out + "\\bottomrule\n\\end{tabular}\n";
}

// A further tabular, under its caption if it has one; nothing without rows.
std::string formatLatexPart(const std::string& caption, const TableGrid& grid) {
  if (grid.rows.empty()) return "";
  const std::string above = caption.empty() ? "" : escapeLatex(caption) + "\n\n\\smallskip\n";
  return "\n\\medskip\n" + above + formatLatexTabular(grid);
}

// Moves the last column, where it has something, to a table of its own.
TableGrid cutLastColumn(TableGrid& grid) {
  TableGrid cut;
  cut.header = {grid.header[0], grid.header[1], grid.header.back()};
  grid.header.pop_back();
  for (std::vector<std::string>& row : grid.rows) {
    if (!row.back().empty()) cut.rows.push_back({row[0], row[1], row.back()});
    row.pop_back();
  }
  return cut;
}

}  // namespace

std::string renderMarkdown(const std::vector<TableBlock>& blocks) {
  std::string out;
  for (const TableBlock& block : blocks) {
    const TableText text = computeTableText(block);
    out += fmt::format("### {}\n\n{}\n\n{}\n{}\n\n", escapeMarkdown(text.title),
                       escapeMarkdown(text.machine), formatMarkdownTable(text.costs),
                       escapeMarkdown(text.ratios));
    if (!text.why.rows.empty())
      out +=
          fmt::format("{}\n\n{}\n", escapeMarkdown(text.whyCaption), formatMarkdownTable(text.why));
    if (!text.quality.rows.empty())
      out += fmt::format("{}\n\n{}\n", escapeMarkdown(text.qualityCaption),
                         formatMarkdownTable(text.quality));
    for (const std::string& note : text.notes) out += "- " + escapeMarkdown(note) + "\n";
    if (!text.notes.empty()) out += "\n";
  }
  for (const std::string& note : computeTableNotes(blocks))
    out += "- " + escapeMarkdown(note) + "\n";
  return out;
}

std::string renderLatex(const std::vector<TableBlock>& blocks) {
  std::string out = "% Needs \\usepackage{booktabs}.\n";
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    TableText text = computeTableText(blocks[i]);
    // a page is too narrow for nine columns
    const TableGrid limit = text.hasLimit ? cutLastColumn(text.costs) : TableGrid();
    out += fmt::format("\\begin{{table}}\n\\centering\n\\caption{{{}}}\n", escapeLatex(text.title));
    // Eight columns fit the text width of the standard classes only when set small and close.
    out += "\\footnotesize\\setlength{\\tabcolsep}{3pt}\n" + formatLatexTabular(text.costs);
    out += formatLatexPart("", limit) + formatLatexPart(text.whyCaption, text.why) +
           formatLatexPart(text.qualityCaption, text.quality);
    out += "\n\\medskip\n\\raggedright\n";
    std::vector<std::string> notes{text.machine, text.ratios};
    notes.insert(notes.end(), text.notes.begin(), text.notes.end());
    const std::vector<std::string> shared = computeTableNotes(blocks);
    if (i + 1 == blocks.size()) notes.insert(notes.end(), shared.begin(), shared.end());
    for (const std::string& note : notes) out += escapeLatex(note) + "\\par\n";
    out += "\\end{table}\n";
  }
  return out;
}

}  // namespace hlodbench
