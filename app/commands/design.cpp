// `gridshell design PRESET`: what is moved so that a shell meets its surface.
#include <CLI/CLI.hpp>
#include <memory>

#include "app/commands/commands.h"
#include "app/designs.h"

namespace gridshell::app {

void add_design(CLI::App& program, Action& action) {
  const auto options = std::make_shared<Options>();
  auto* command = program.add_subcommand(
      "design", "moves pins, legs, held directions or diameters until the shell meets its surface");
  add_preset_options(*command, *options);
  add_work_options(*command, *options, "folder to write, by default out/<preset>_design");
  add_picture_options(*command, *options);
  command->callback(
      [&action, options] { action = [options] { return produce_design(*options); }; });
}

}  // namespace gridshell::app
