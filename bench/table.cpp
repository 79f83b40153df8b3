#include "table.h"

#include <fmt/format.h>

#include "hlod/core/error.h"
#include "metrics/image_result.h"
#include "metrics/result_json.h"
#include "table_text.h"

namespace hlodbench {

std::string renderTable(const std::vector<std::filesystem::path>& dirs, TableFormat format) {
  if (dirs.empty()) throw InputError("table: expected one result folder or more, found none");
  std::vector<TableBlock> blocks;
  for (const std::filesystem::path& dir : dirs)
    blocks.push_back(computeTableBlock(dir, readRunResult(dir), readImageSummaries(dir)));
  switch (format) {
    case TableFormat::kMarkdown:
      return renderMarkdown(blocks);
    case TableFormat::kLatex:
      return renderLatex(blocks);
    case TableFormat::kCsv:
      return renderCsv(blocks);
  }
  return {};
}

}  // namespace hlodbench
