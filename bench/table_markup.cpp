// The two ways to set a table for reading.

#include <fmt/format.h>

#include <algorithm>

#include "markdown.h"
#include "table_text.h"

namespace hlodbench {
namespace {

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

// Columns of text, then columns of numbers.
std::string computeAlignment(const TableGrid& grid) {
  return std::string(kFirstNumberColumn, 'l') +
         std::string(grid.header.size() - kFirstNumberColumn, 'r');
}

std::string formatMarkdownGrid(const TableGrid& grid) {
  return formatMarkdownTable(grid.header, grid.rows, computeAlignment(grid));
}

std::string formatLatexRow(const std::vector<std::string>& cells) {
  std::string row;
  for (const std::string& cell : cells) row += (row.empty() ? "" : " & ") + escapeLatex(cell);
  // The row before ends in two backslashes, which take a bracket or a star as their argument.
  if (!row.empty() && (row[0] == '[' || row[0] == '*')) row.insert(0, "{}");
  return row + " \\\\\n";
}

std::string formatLatexTabular(const TableGrid& grid) {
  std::string out =
      "\\begin{tabular}{" + computeAlignment(grid) + "}\n\\toprule\n" + formatLatexRow(grid.header);
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
                       escapeMarkdown(text.machine), formatMarkdownGrid(text.costs),
                       escapeMarkdown(text.ratios));
    if (!text.why.rows.empty())
      out +=
          fmt::format("{}\n\n{}\n", escapeMarkdown(text.whyCaption), formatMarkdownGrid(text.why));
    if (!text.quality.rows.empty())
      out += fmt::format("{}\n\n{}\n", escapeMarkdown(text.qualityCaption),
                         formatMarkdownGrid(text.quality));
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
