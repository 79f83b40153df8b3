#include <fmt/format.h>

#include <memory>

#include "commands.h"
#include "table.h"

namespace hlodbench {
namespace {

struct TableCommand {
  std::vector<std::filesystem::path> folders;
  std::string format = "markdown";
};

}  // namespace

void addTableCommand(CLI::App& app) {
  auto command = std::make_shared<TableCommand>();
  CLI::App* sub =
      app.add_subcommand("table", "Print Table 1 of the paper, its printed values beside yours");
  sub->add_option("dir", command->folders, "result folders of `hlodbench run`")->required();
  sub->add_option("--format", command->format, "markdown, latex or csv")->capture_default_str();
  sub->callback([command] {
    fmt::print("{}", renderTable(command->folders, parseTableFormat(command->format)));
  });
}

}  // namespace hlodbench
