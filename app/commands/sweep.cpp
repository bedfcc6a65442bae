// `gridshell sweep PRESET`: many runs of one preset, resumable, on several cores or machines.
#include <CLI/CLI.hpp>
#include <memory>

#include "app/commands/commands.h"
#include "app/sweeps.h"

namespace gridshell::app {

void add_sweep(CLI::App& program, Action& action) {
  const auto options = std::make_shared<SweepOptions>();
  auto* command = program.add_subcommand("sweep", "many runs of one preset, resumable, parallel");
  add_preset_options(*command, options->common);
  add_work_options(*command, options->common);
  command
      ->add_option("--jobs", options->jobs,
                   "points computed at a time, by default as many as there are cores; results do "
                   "not change")
      ->check(CLI::Range(1, 1024));
  auto* shard =
      command->add_option("--shard", options->shard, "i/N: every N-th point, in DIR/shard_i_of_N");
  command->add_flag("--merge", options->merge, "gather the shards in DIR instead of computing")
      ->excludes(shard);
  command->callback([&action, options] { action = [options] { return sweep(*options); }; });
}

}  // namespace gridshell::app
