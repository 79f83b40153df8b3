#pragma once

#include <string>
#include <vector>

#include "table_model.h"

namespace hlodbench {

// Plain text in UTF-8; an en dash stands where the paper prints a dash.
struct TableGrid {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;  // as many cells as the header
  std::vector<std::size_t> groupStarts;        // rows that begin a strategy
};

// A block as text, before any markup: what the Markdown and the LaTeX table have in common.
struct TableText {
  std::string title;      // scene, session, size
  std::string machine;    // program, revision, processor, renderer, time
  TableGrid costs;        // Table 1
  bool hasLimit = false;  // its last column has the shares of Oracle's FPS
  TableGrid why;          // what explains them; no rows without --explain
  std::string whyCaption;
  std::string ratios;  // one line
  TableGrid quality;   // of the pictures; no rows without them
  std::string qualityCaption;
  std::vector<std::string> notes;  // of this block: failures, what is missing, warnings
};

// Columns from this one on hold numbers.
inline constexpr std::size_t kFirstNumberColumn = 2;

TableText computeTableText(const TableBlock& block);

// The table of what explains the costs; no rows when the run explained no frame.
TableGrid computeWhyGrid(const TableBlock& block);
std::string computeWhyCaption(const TableBlock& block);

// The table of picture quality; no rows when the run made no pictures.
TableGrid computeQualityGrid(const TableBlock& block);
std::string computeQualityCaption(const TableBlock& block);

// What holds for all blocks of a table: what is averaged, what FPS and Speedup mean.
std::vector<std::string> computeTableNotes(const std::vector<TableBlock>& blocks);

// One row per (folder, strategy) with a header line (RFC 4180, but lines end in "\n").
std::string renderCsv(const std::vector<TableBlock>& blocks);
std::string renderMarkdown(const std::vector<TableBlock>& blocks);
std::string renderLatex(const std::vector<TableBlock>& blocks);

}  // namespace hlodbench
