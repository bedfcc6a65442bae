// `gridshell chart accuracy|stability PRESET`: speed against accuracy; where methods hold and fail.
#include <CLI/CLI.hpp>
#include <memory>

#include "app/charts.h"
#include "app/commands/commands.h"

namespace gridshell::app {

void add_chart(CLI::App& program, Action& action) {
  const auto options = std::make_shared<ChartOptions>();
  auto* command =
      program.add_subcommand("chart", "speed against accuracy; where methods hold and fail");
  command->add_option("KIND", options->kind, "accuracy or stability")
      ->required()
      ->check(CLI::IsMember({"accuracy", "stability"}));
  add_preset_options(*command, options->common);
  add_work_options(*command, options->common,
                   "folder to write, by default out/<preset>_<accuracy or stability>");
  command
      ->add_option(
          "--limit", options->limit_s,
          "seconds after which a run is too slow: by default 30 for accuracy, 4 for stability")
      ->check(CLI::Range(0.01, 1e6));
  command
      ->add_option("--edges", options->edges,
                   "edges a segment of the finest mesh that methods are given")
      ->check(CLI::Range(4, 32));
  command->callback([&action, options] { action = [options] { return chart(*options); }; });
}

}  // namespace gridshell::app
