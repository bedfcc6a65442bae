// `gridshell movie PRESET`: the main job, an experiment and its movie.
#include <CLI/CLI.hpp>
#include <memory>

#include "app/commands/commands.h"
#include "app/production.h"

namespace gridshell::app {

void add_movie(CLI::App& program, Action& action) {
  const auto options = std::make_shared<Options>();
  auto* command =
      program.add_subcommand("movie", "run the experiment and render it: frames and a movie");
  add_preset_options(*command, *options);
  add_work_options(*command, *options);
  add_picture_options(*command, *options);
  command->callback(
      [&action, options] { action = [options] { return produce(*options, Pictures::movie); }; });
}

}  // namespace gridshell::app
