// `gridshell export RUN --to FILE`: for other programs and for the workshop.
#include <CLI/CLI.hpp>
#include <memory>

#include "app/commands/commands.h"
#include "app/exporting.h"

namespace gridshell::app {

void add_export(CLI::App& program, Action& action) {
  const auto options = std::make_shared<ExportOptions>();
  auto* command = program.add_subcommand(
      "export", "a run's shape for other programs, its footprint for the workshop");
  command
      ->add_option("RUN", options->input, "folder of a run; for what is not a shape a PRESET too")
      ->required();
  command->add_option("--to", options->to, "the file; its extension is the format")->required();
  command->add_option("--what", options->what,
                      "shape, tubes, footprint, plate, cutlist or sheet; by default what the "
                      "extension is for");
  command->add_option("--frame", options->frame,
                      "of a shape: index of its frame, by default the last");
  command->add_option("--case", options->case_name, "of several cases: which");
  command->add_option("--seconds", options->seconds, "of an animation (.glb)")
      ->check(CLI::Range(0.1, 3600.0));
  command->add_flag("--unsealed", options->unsealed,
                    "take a trajectory.h5 that another program wrote or changed");
  command->footer("What is exported, and how:\n" + exported_formats());
  command->callback([&action, options] { action = [options] { return export_file(*options); }; });
}

}  // namespace gridshell::app
