// `gridshell figure PRESET`: an experiment and its stills.
#include <CLI/CLI.hpp>
#include <memory>

#include "app/commands/commands.h"
#include "app/production.h"

namespace gridshell::app {

void add_figure(CLI::App& program, Action& action) {
  const auto options = std::make_shared<Options>();
  auto* command = program.add_subcommand("figure", "the stills of a preset");
  add_preset_options(*command, *options);
  add_work_options(*command, *options);
  add_picture_options(*command, *options);
  command->callback(
      [&action, options] { action = [options] { return produce(*options, Pictures::stills); }; });
}

}  // namespace gridshell::app
