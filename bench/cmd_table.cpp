#include <fmt/format.h>

#include <memory>

#include "choice.h"
#include "commands.h"
#include "table.h"

namespace hlodbench {
namespace {

struct TableCommand {
  std::vector<std::filesystem::path> folders;
  TableFormat format = TableFormat::kMarkdown;
};

}  // namespace

void addTableCommand(CLI::App& app) {
  auto command = std::make_shared<TableCommand>();
  CLI::App* sub =
      app.add_subcommand("table", "Print Table 1 of the paper, its printed values beside yours");
  sub->add_option("dir", command->folders, "result folders of `hlodbench run`")->required();
  addChoice<TableFormat>(*sub, "--format", command->format,
                         {{"markdown", TableFormat::kMarkdown},
                          {"latex", TableFormat::kLatex},
                          {"csv", TableFormat::kCsv}},
                         "of the table");
  sub->callback([command] { fmt::print("{}", renderTable(command->folders, command->format)); });
}

}  // namespace hlodbench
