#include "app/cli/commands.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "app/cli/chart.h"
#include "app/cli/console.h"
#include "app/cli/pictures.h"
#include "app/cli/preset_library.h"
#include "app/cli/produce.h"
#include "app/cli/reference.h"
#include "app/cli/staged_folder.h"
#include "engine/core/try.h"
#include "engine/gridshell.h"

namespace gridshell::app {

void add_commands(CLI::App& program, Action& action) {
  add_movie(program, action);
  add_figure(program, action);
  add_run(program, action);
  add_render(program, action);
  add_view(program, action);
  add_chart(program, action);
  add_sweep(program, action);
  add_design(program, action);
  add_export(program, action);
  add_scan(program, action);
  add_check(program, action);
  add_compare(program, action);
  add_list(program, action);
}

namespace {

/// "TEXT:{auto,osmesa}" names the words of a choice.
std::vector<std::string> words_in(const std::string& type) {
  const auto begin = type.find('{'), end = type.find('}');
  if (begin == type.npos || end == type.npos || end < begin) return {};
  return CLI::detail::split(type.substr(begin + 1, end - begin - 1), ',');
}

CommandOption entry_of(const CLI::Option& option) {
  CommandOption entry;
  entry.argument = option.get_positional();
  entry.name = entry.argument ? option.get_name(true) : option.get_name();
  if (!entry.argument && !option.get_lnames().empty()) entry.name = "--" + option.get_lnames()[0];
  if (!option.get_snames().empty()) entry.short_name = "-" + option.get_snames()[0];
  entry.meaning = option.get_description();
  entry.words = words_in(option.get_type_name());
  entry.flag = option.get_items_expected_max() == 0;
  entry.required = option.get_required();
  entry.many = option.get_items_expected_max() > 1;
  return entry;
}

}  // namespace

std::vector<CommandEntry> command_table() {
  CLI::App program;
  Action action;
  add_commands(program, action);
  std::vector<CommandEntry> table;
  for (const CLI::App* command : program.get_subcommands({})) {
    CommandEntry entry{command->get_name(), command->get_description(), command->get_footer(), {}};
    for (const CLI::Option* option : command->get_options())
      entry.options.push_back(entry_of(*option));
    table.push_back(std::move(entry));
  }
  return table;
}

// `gridshell movie PRESET`: the main job, an experiment and its movie.

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

// `gridshell figure PRESET`: an experiment and its stills.

void add_figure(CLI::App& program, Action& action) {
  const auto options = std::make_shared<Options>();
  auto* command = program.add_subcommand("figure", "the stills of a preset");
  add_preset_options(*command, *options);
  add_work_options(*command, *options);
  add_picture_options(*command, *options);
  command->callback(
      [&action, options] { action = [options] { return produce(*options, Pictures::stills); }; });
}

// `gridshell run PRESET`: an experiment without pictures.

void add_run(CLI::App& program, Action& action) {
  const auto options = std::make_shared<Options>();
  auto* command = program.add_subcommand("run", "the experiment alone, no pictures");
  add_preset_options(*command, *options);
  add_work_options(*command, *options);
  add_picture_options(*command, *options);
  command->callback(
      [&action, options] { action = [options] { return produce(*options, Pictures::none); }; });
}

// `gridshell chart accuracy|stability|branches PRESET`, `gridshell chart trust`: speed against
// accuracy; where methods hold and fail; the bifurcation diagram; whether results can be trusted.

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

// `gridshell check PRESET`: validates a preset and explains what would run.

namespace {

std::string or_unknown(double value, const char* unit) {
  return std::isnan(value) ? "unknown" : fmt::format("{:.2g} {}", value, unit);
}

void print_plan(const preset::Preset& preset, const simulate::Plan& plan) {
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
  TRY(presets, load(options));
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

// `gridshell list`: the presets that come with the program, and the reference of
// all keys, options and commands.

namespace {

int list_presets() {
  std::size_t longest = 0;
  for (const auto& embedded : embedded_presets()) longest = std::max(longest, embedded.name.size());
  for (const auto& embedded : embedded_presets()) {
    const auto presets = load_preset(embedded.name, {});
    if (!presets) return report(presets.error());
    const auto& source = presets->base.source;
    fmt::print("{:<{}}  {}{}\n", embedded.name, longest, presets->base.title,
               source.empty() ? "" : " (" + source + ")");
  }
  return ExitCode::done;
}

int print(const Result<std::string>& text) {
  if (!text) return report(text.error());
  fmt::print("{}", *text);
  return ExitCode::done;
}

}  // namespace

void add_list(CLI::App& program, Action& action) {
  struct What {
    std::string keys, completion;
    bool json = false, man = false;
  };
  const auto what = std::make_shared<What>();
  auto* command = program.add_subcommand("list", "the presets that come with the program");
  command->add_option("--keys", what->keys, "instead, the reference of all keys a preset can hold")
      ->check(CLI::IsMember({"markdown"}));
  command->add_flag("--json", what->json,
                    "instead, all commands, options, presets and keys for other programs");
  command->add_option("--completion", what->completion, "instead, a script for a shell")
      ->check(CLI::IsMember({"bash"}));
  command->add_flag("--man", what->man, "instead, the manual page");
  command->callback([&action, what] {
    action = [what]() -> int {
      if (!what->keys.empty()) return print(preset::reference_markdown());
      if (!what->completion.empty()) return print(bash_completion());
      if (what->json) return print(listing_json());
      if (what->man) return print(man_page());
      return list_presets();
    };
  });
}

}  // namespace gridshell::app
