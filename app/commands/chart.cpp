// `gridshell chart accuracy|stability|branches PRESET`, `gridshell chart trust`: speed against
// accuracy; where methods hold and fail; the bifurcation diagram; whether results can be trusted.
#include <CLI/CLI.hpp>
#include <memory>

#include "app/charts.h"
#include "app/commands/commands.h"
#include "app/trust.h"

namespace gridshell::app {

void add_chart(CLI::App& program, Action& action) {
  const auto options = std::make_shared<ChartOptions>();
  auto* command = program.add_subcommand(
      "chart", "speed against accuracy; where methods hold and fail; branches; trust");
  command
      ->add_option("KIND", options->kind,
                   "accuracy, stability, branches (the bifurcation diagram), or trust (random "
                   "scenes, no PRESET)")
      ->required()
      ->check(CLI::IsMember({"accuracy", "stability", "branches", "trust"}));
  add_preset_options(*command, options->common);
  command->get_option("PRESET")->required(false);
  add_work_options(*command, options->common,
                   "folder to write, by default out/<preset>_<KIND>, or out/trust");
  command
      ->add_option("--limit", options->limit_s,
                   "seconds after which a run is too slow: by default 30 for accuracy, 4 for "
                   "stability, 20 for trust")
      ->check(CLI::Range(0.01, 1e6));
  command
      ->add_option("--edges", options->edges,
                   "edges a segment of the finest mesh that methods are given")
      ->check(CLI::Range(4, 32));
  command->add_option("--scenes", options->scenes, "of trust: how many, of ten kinds in turn")
      ->check(CLI::Range(1, 100000));
  command->add_option("--seed", options->seed, "of trust: other scenes")
      ->check(CLI::Range(0, 1 << 30));
  command->callback([&action, options] {
    const bool trust = options->kind == "trust";
    if (trust != options->common.input.empty())
      throw CLI::ValidationError(trust ? "chart trust takes no PRESET: its scenes are random"
                                       : "chart " + options->kind + " needs a PRESET");
    action = [options, trust] { return trust ? chart_trust(*options) : chart(*options); };
  });
}

}  // namespace gridshell::app
