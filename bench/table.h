#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hlodbench {

enum class TableFormat { kMarkdown, kLatex, kCsv };

// The paper's Table 1 from result folders (each with a run.json): a block a folder, in the order
// given, with the rows Bool, SW(B), Simp(B), Coh(B), then other strategies by id. Every row is
// followed by the paper's printed values: those of scene 1 for a scene named "scene1", of scene 2
// for "scene2", and of both, marked as another scene, for any other.
// A run with Oracle adds a column, each strategy's share of its frame rate; one with --explain a
// table of what explains the costs.
// A run with pictures adds a table of their quality: PSNR against Bool's, as in the paper's section
// 5.3, and against the full-resolution model.
//   Markdown  aligned columns; notes below each block and at the end
//   LaTeX     tables for \input, need \usepackage{booktabs}
//   CSV       a row per (folder, strategy), numbers unrounded, ours_* and paper_* columns; those of
//             the share of Oracle where a folder has it
// Values are averages over all frames and repetitions, warm-up excluded. Failed cases and what is
// missing from an interrupted run are named in notes. Throws InputError for an empty list, a
// folder without run.json or a run.json that cannot be read.
std::string renderTable(const std::vector<std::filesystem::path>& dirs, TableFormat format);

}  // namespace hlodbench
