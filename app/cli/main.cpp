// The program `gridshell`: reads the command line, runs one command, returns its exit code.
#include <cstdio>
#include <exception>
#include <system_error>

#include "app/cli/commands.h"
#include "app/cli/console.h"
#include "render/gl/context.h"

namespace {

int run(int argc, char** argv) {
  gridshell::app::CommandLine program;
  gridshell::app::add_commands(program);
  return program.run(argc, argv);
}

}  // namespace

int main(int argc, char** argv) {
  gridshell::app::install_signal_handlers();
  gridshell::app::install_terminate_handler();
  gridshell::app::open_standard_streams();
  gridshell::render::keep_compiled_shaders();
  int code = gridshell::app::ExitCode::failed;
  int not_printed = 0;
  try {
    code = run(argc, argv);
  } catch (const std::system_error& error) {
    // a failed write to stdout is reported below
    if (std::ferror(stdout))
      not_printed = error.code().value();
    else
      code = gridshell::app::report_exception(error);
  } catch (const std::exception& error) {
    code = gridshell::app::report_exception(error);
  }
  // what could not be printed was not done
  if (!gridshell::app::flush_stdout(not_printed) && code == gridshell::app::ExitCode::done)
    code = gridshell::app::ExitCode::failed;
  return code;
}
