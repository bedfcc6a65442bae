// `gridshell scan POINTS RUN...`: a 3D scan against a run's joints.
#include <CLI/CLI.hpp>
#include <memory>

#include "app/commands/commands.h"
#include "app/scans.h"

namespace gridshell::app {

void add_scan(CLI::App& program, Action& action) {
  const auto options = std::make_shared<ScanOptions>();
  auto* command =
      program.add_subcommand("scan", "which state a 3D scan shows, and how far its joints are off");
  command->add_option("POINTS", options->common.input, "cloud of points: .ply, .xyz or .csv, mm")
      ->required();
  command->add_option("RUN", options->runs, "folders of runs; of a search all of its states")
      ->required();
  add_changes(*command, options->common);
  add_work_options(*command, options->common, "folder to write, by default out/<points>_scan");
  add_picture_options(*command, options->common);
  command->add_flag("--unsealed", options->unsealed,
                    "take a trajectory.h5 that another program wrote or changed");
  command->footer(
      "The exit code is 3 where the scan shows none of the states. Joints are cylinders of\n"
      "[joints] diameter_mm and height_mm, of which the scan sees the tops.");
  command->callback([&action, options] { action = [options] { return produce_scan(*options); }; });
}

}  // namespace gridshell::app
