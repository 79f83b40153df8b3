// hlodbench: the command line.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <clocale>
#include <new>

#include "commands.h"
#include "hlod/core/error.h"

namespace {

int fail(hlodbench::ExitCode code, const char* message) {
  fmt::print(stderr, "hlodbench: {}\n", message);
  return static_cast<int>(code);
}

}  // namespace

int main(int argc, char** argv) {
  using namespace hlodbench;
  const std::vector<std::string> arguments(argv, argv + argc);
  CLI::App app{
      "HLOD rendering driven by hardware occlusion queries: replays a recorded camera session "
      "with\n"
      "several traversal strategies on one renderer and logs what each of them costs.",
      "hlodbench"};
  app.set_version_flag("--version", "hlodbench " HLODBENCH_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 ok, 1 a check or comparison failed, 2 wrong usage or input, 3 no usable GL.");
  addListCommand(app, arguments);
  addBuildCommand(app);
  addInfoCommand(app);
  addRunCommand(app, arguments);
  addViewCommand(app);
  addTableCommand(app);
  addCompareCommand(app);
  addBiasCommand(app);
  try {
    app.parse(argc, argv);
    return static_cast<int>(ExitCode::kOk);
  } catch (const CLI::CallForHelp& help) {
    return app.exit(help);
  } catch (const CLI::CallForVersion& version) {
    return app.exit(version);
  } catch (const CLI::RuntimeError& result) {
    return result.get_exit_code();  // a command that ended with a code of its own
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "hlodbench: {} (see hlodbench --help)\n", error.what());
    return static_cast<int>(ExitCode::kBadInput);
  } catch (const InputError& error) {
    return fail(ExitCode::kBadInput, error.what());
  } catch (const GlUnavailable& error) {
    return fail(ExitCode::kNoGl, error.what());
  } catch (const std::bad_alloc&) {
    return fail(ExitCode::kBadInput, "out of memory: the scene is too large for this machine");
  } catch (const std::exception& error) {
    return fail(ExitCode::kCheckFailed, error.what());
  }
}
