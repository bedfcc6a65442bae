// `gridshell check PRESET`: validates a preset and explains what would run.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <memory>

#include "app/commands/commands.h"
#include "app/console.h"
#include "app/loading.h"
#include "app/pictures.h"
#include "app/staging.h"
#include "engine/design/refused_net.h"
#include "engine/preset/writer.h"

namespace gridshell::app {
namespace {

std::string or_unknown(double value, const char* unit) {
  return std::isnan(value) ? "unknown" : fmt::format("{:.2g} {}", value, unit);
}

void print_plan(const preset::Preset& preset, const experiment::Plan& plan) {
  fmt::print("{}: {}\n", preset.name, preset.title);
  fmt::print("  footprint       {}\n", plan.footprint);
  if (preset.footprint.kind == preset::FootprintKind::circle)
    fmt::print("  boundary        {} mm to {} mm\n", preset.original_radius_mm(),
               preset.actuated_radius_mm());
  for (const auto& seam : plan.seams) fmt::print("  seam            {}\n", seam);
  fmt::print("  model           {}\n", plan.model_reason);
  fmt::print("  meshes          {} edges a segment{}\n", fmt::join(plan.levels, ", "),
             plan.extrapolated ? ", extrapolated" : "");
  fmt::print("  size            {} rods, {} joints, {} cells, {} unknowns\n", plan.rods,
             plan.joints, plan.cells, plan.dof);
  if (preset.jitter.wanted())
    fmt::print("  search          {} trials, mode \"{}\", and {} from symmetric forms\n",
               preset.jitter.trials, word_of(preset.jitter.mode), preset.jitter.confined);
  fmt::print("  memory          about {:.1g} GB\n", plan.memory_GB);
  fmt::print("  expected error  {}\n", or_unknown(plan.expected_error_mm, "mm"));
  fmt::print("  expected time   {} to simulate, {} to draw the movie, {} the figure\n",
             or_unknown(plan.expected_seconds, "s"),
             or_unknown(expected_seconds(Pictures::movie, preset), "s"),
             or_unknown(expected_seconds(Pictures::stills, preset), "s"));
}

Result<void> check(const Options& options) {
  const auto presets = load(options);
  if (!presets) return tl::unexpected(presets.error());
  if (options.print_config) {
    fmt::print("{}", preset::to_toml(*presets));
    return {};
  }
  // what `run` would say after it
  const auto folder = output_of(options, presets->base);
  if (const auto because = refusal_to_write(folder); !because.empty())
    return fail(Fault::bad_input,
                fmt::format("cannot write the folder '{}': {}", folder.string(), because));
  for (const auto& run : runs_of(*presets)) {
    const auto plan = plan_of(run.preset);
    if (!plan) {
      Error error = plan.error();
      if (refused_net(run.preset))
        error.message += "\n'gridshell figure' draws the net as far as it comes";
      return tl::unexpected(error);
    }
    print_plan(run.preset, *plan);
  }
  return {};
}

}  // namespace

void add_check(CLI::App& program, Action& action) {
  const auto options = std::make_shared<Options>();
  auto* command = program.add_subcommand("check", "validate a preset and say what would run");
  add_preset_options(*command, *options);
  // the command line of a movie can be checked as it stands
  add_work_options(*command, *options);
  add_picture_options(*command, *options);
  command->callback([&action, options] {
    action = [options]() -> int {
      const auto checked = check(*options);
      return checked ? ExitCode::done : report(checked.error());
    };
  });
}

}  // namespace gridshell::app
