// The program `gridshell`: reads the command line, runs one command, returns its exit code.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>

#include "app/cli/commands.h"
#include "app/cli/console.h"
#include "engine/core/suggest.h"
#include "engine/core/system_info.h"
#include "render/gl/context.h"

namespace {

using namespace gridshell;

// a mistyped command deserves a better answer than "not expected"
// empty when `word` is a command
std::string no_such_command(const CLI::App& program, const std::string& word) {
  std::vector<std::string> names;
  for (const auto* command : program.get_subcommands({})) names.push_back(command->get_name());
  if (std::ranges::find(names, word) != names.end()) return "";
  return "no command '" + word + "'" + did_you_mean(word, names) +
         " ('gridshell --help' lists them)";
}

int run(int argc, char** argv) {
  CLI::App program("Elastic gridshells: formed, measured and shown.", "gridshell");
  program.set_version_flag("--version", gridshell::version());
  program.require_subcommand(1);
  app::Action action;
  app::add_commands(program, action);
  if (argc > 1 && argv[1][0] != '-')
    if (const auto fault = no_such_command(program, argv[1]); !fault.empty())
      return app::report({Fault::bad_input, fault});
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // help and version come as errors too, with code 0
    return program.exit(error) == 0 ? app::ExitCode::done : app::ExitCode::bad_input;
  }
  return app::report(action());
}

}  // namespace

int main(int argc, char** argv) {
  gridshell::app::install_signal_handlers();
  gridshell::app::install_terminate_handler();
  gridshell::app::open_standard_streams();
  gridshell::render::keep_compiled_shaders();
  int code = gridshell::app::ExitCode::failed;
  try {
    code = run(argc, argv);
  } catch (const std::exception& error) {
    code = gridshell::app::report_exception(error);
  }
  // what could not be printed was not done
  if (!gridshell::app::flush_stdout() && code == gridshell::app::ExitCode::done)
    code = gridshell::app::ExitCode::failed;
  return code;
}
