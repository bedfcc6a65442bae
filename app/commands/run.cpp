// `gridshell run PRESET`: an experiment without pictures.
#include <CLI/CLI.hpp>
#include <memory>

#include "app/commands/commands.h"
#include "app/production.h"

namespace gridshell::app {

void add_run(CLI::App& program, Action& action) {
  const auto options = std::make_shared<Options>();
  auto* command = program.add_subcommand("run", "the experiment alone, no pictures");
  add_preset_options(*command, *options);
  add_work_options(*command, *options);
  add_picture_options(*command, *options);
  command->callback(
      [&action, options] { action = [options] { return produce(*options, Pictures::none); }; });
}

}  // namespace gridshell::app
