// Commands that study a formed shell and draw displacements from it: `load`, `modes`.

#include <fmt/format.h>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/cli/command_line.h"
#include "app/cli/commands.h"
#include "app/cli/console.h"
#include "app/cli/delivery.h"
#include "app/cli/pictures.h"
#include "app/cli/preset_library.h"
#include "app/cli/produce.h"
#include "engine/core/file_io.h"
#include "engine/core/json.h"
#include "engine/core/try.h"
#include "engine/gridshell.h"
#include "render/canvas/text.h"
#include "render/movie/state_charts.h"
#include "render/movie/stills.h"

namespace gridshell::app {
namespace fs = std::filesystem;
namespace {

/// Result of the study of one run's shell.
struct FormedStudy {
  std::vector<std::pair<std::string, std::string>> files;  ///< names and texts
  std::string text = {};                                   ///< for the terminal, indented lines
  record::Trajectory state;                                ///< the shell, one frame
  record::Summary summary;
  record::FrameList moves = {};            ///< displaced shells (moved_by()), a still for each
  std::vector<std::string> captions = {};  ///< of the stills, marked text
  /// Draws further pictures; may be empty.
  std::function<Result<void>(render::Renderer&, const fs::path& folder, Progress&)> draw_more = {};
};

/// How `load` or `modes` studies a formed shell.
struct FormedCommand {
  std::string folder_end, finds;  ///< "_modes", "natural frequencies"
  std::function<Result<FormedStudy>(const preset::Preset&, Watch&)> find;
  double paths = 1;  ///< its time, as a multiple of that of forming the shell
  std::function<int(const preset::Preset&)> stills;  ///< the most that it draws
  std::function<std::vector<Phase>(const preset::Preset&)> drawn_more = {};  ///< for draw_more
};

Result<void> draw(preset::Preset preset, const FormedStudy& found, const std::string& context,
                  const fs::path& folder, Progress& progress) {
  TRY(maker, PictureMaker::create(context, preset.style.font));
  preset.movie.colour_by = preset::ColourBy::displacement;
  preset.movie.turn_deg = 0;
  if (!preset.title.empty())
    preset.title += ": shapes, largest displacement drawn as " +
                    render::length_text(drawn_move_mm(found.state.layout));
  Watch& watch = progress.next_phase();
  if (!found.moves.empty())
    TRY_DO(render::write_stills({found.state.layout, found.moves},
                                style_of(preset, Pictures::stills), bar_of_moves, maker->renderer(),
                                folder / fs::path(preset.name).filename(), watch, found.captions,
                                &found.state.frames.back()));
  if (!found.draw_more) return {};
  return found.draw_more(maker->renderer(), folder, progress);
}

/// Studies one run and writes its folder. Appends lines for the terminal to `text`, and to `fault`
/// why the shell is not the requested one (failure_of()).
Result<void> study_one(const preset::Case& run, const FormedCommand& command,
                       const std::string& context, const fs::path& folder, Progress& progress,
                       std::string& text, std::string& fault) {
  TRY(found, with_name_of(run.preset, command.find(run.preset, progress.next_phase())));
  TRY_DO(make_folder(folder));
  TRY_DO(write_file(folder / "preset.toml", saved_preset(preset::to_toml(run.preset))));
  for (const auto& [name, content] : found->files) TRY_DO(write_file(folder / name, content));
  found->summary.kind = record::Kind::figure;
  TRY_DO(record::write_summary(folder / "summary.json", found->summary));
  if (!run.name.empty()) text += run.name + ":\n";
  text += found->text;
  if (const auto why = failure_of(found->summary, run.preset.allow_unstable); !why.empty())
    fault += fmt::format("{}: {}\n", run.preset.name, why);
  return draw(run.preset, *found, context, folder, progress);
}

/// Studies every run of a preset: writes its tables, preset and summary, then stills of the
/// displaced shells, OUT/<preset>_1.png ... Prints the results; returns the exit code.
Result<int> study_formed(const Options& options, const FormedCommand& command) {
  TRY(presets, load(options));
  if (options.print_config) return print_config(*presets);
  const auto runs = runs_of(*presets);
  const auto folder = output_of(options, presets->base, command.folder_end);
  std::vector<Phase> phases;
  for (const auto& run : runs) {
    TRY(plan, plan_of(run.preset));
    const double seconds = std::isnan(plan->expected_seconds) ? 1 : plan->expected_seconds;
    phases.push_back({"finding " + command.finds, command.paths * seconds});
    phases.push_back(drawing(
        "drawing", command.stills(run.preset) * expected_seconds(Pictures::stills, run.preset)));
    if (!command.drawn_more) continue;
    for (Phase& phase : command.drawn_more(run.preset)) phases.push_back(std::move(phase));
  }
  std::string text, fault;
  TRY_DO(deliver({folder, command.folder_end.substr(1)}, phases, options.quiet,
                 [&](const fs::path& partial, Progress& progress) -> Result<void> {
                   for (const auto& run : runs)
                     TRY_DO(study_one(run, command, options.context, folder_of(partial, run.name),
                                      progress, text, fault));
                   return {};
                 }));
  if (!options.quiet) fmt::print("{}: {}\n{}", folder.string(), command.finds, text);
  fmt::print(stderr, "{}", fault);
  return fault.empty() ? ExitCode::done : ExitCode::failed;
}

// `gridshell load PRESET`: the load factors that a formed shell carries, as tables and pictures.

using study::LoadStudy;

struct LoadOptions {
  Options common;
  int imperfections = 0;
};

/// "full snow: limit point at a factor of 3.42 ± 0.02 (linear 5.1 ± 0.1); a rod breaks at a factor
/// of 1.2 ± 0.01; median of 20 imperfect shells: 0.84 of that factor (5 to 95 %: 0.71 to 0.93)"
std::string sentence_of(const record::LoadRow& row) {
  std::string text = row.load_case + ": " + record::loss_text(row);
  if (std::isfinite(row.critical_factor))
    text += " at a factor of " + record::with_error(row.critical_factor, row.error, "");
  if (std::isfinite(row.linear_factor))
    text += " (linear " + record::with_error(row.linear_factor, row.linear_error, "") + ")";
  if (row.strength_factor == 0)
    text += "; the rods BREAK already without that load";
  else if (std::isfinite(row.strength_factor))
    text += "; a rod breaks at a factor of " +
            record::with_error(row.strength_factor, row.strength_error, "");
  const std::string imperfect = record::knock_down_text(row);
  return imperfect.empty() ? text : text + "; " + imperfect;
}

std::string json_text(const LoadStudy& found) {
  Json cases = Json::array();
  for (const record::LoadRow& row : found.cases) cases.push_back(json_of(row));
  Json json = Json::object();
  json["cases"] = std::move(cases);
  return text_of(json);
}

Result<FormedStudy> find_loads(const preset::Preset& preset, int imperfections, Watch& watch) {
  TRY(found, study::load_study(preset, imperfections, watch));
  FormedStudy all{.files = {{"load.csv", record::csv_table(found->points)},
                            {"cases.csv", record::csv_table(found->cases)},
                            {"load.json", json_text(*found)}},
                  .state = found->state,
                  .summary = found->summary};
  for (std::size_t k = 0; k < found->cases.size(); ++k) {
    const record::LoadRow& row = found->cases[k];
    all.text += "  " + sentence_of(row) + "\n";
    if (found->modes[k].size() == 0) continue;
    record::Frame moved = moved_by(found->state, found->modes[k], 1, int(k));
    moved.loads_N = row.critical_factor * found->loads[k];
    all.moves.push_back(std::move(moved));
    all.captions.push_back(fmt::format("{}: factor {}", row.load_case,
                                       record::with_error(row.critical_factor, row.error, "")));
  }
  const auto plot = render::load_plot(found->points, found->cases, preset::title_or_name(preset));
  all.draw_more = [plot, name = fs::path(preset.name).filename().string()](
                      render::Renderer&, const fs::path& folder, Progress&) {
    return render::write_plot((folder / name).string() + "_factors", plot, {.width_mm = 120});
  };
  return all;
}

Result<int> study_loads(const LoadOptions& options) {
  return study_formed(
      options.common,
      {"_load", "load factors",
       [&](const preset::Preset& preset, Watch& watch) {
         return find_loads(preset, options.imperfections, watch);
       },
       4, [](const preset::Preset& preset) { return int(preset.load_case.size()); }});
}

// `gridshell modes PRESET`: how a formed shell vibrates, as a table and as pictures.

using study::Vibrations;

constexpr int frames_of_cycle = 24;

struct ModesOptions {
  Options common;
  int count = 12;
  bool movies = false;
};

std::string frequency_text(const record::ModeRow& mode) {
  if (mode.frequency_Hz >= 0) return record::with_error(mode.frequency_Hz, mode.error_Hz, "Hz");
  return fmt::format(
      "no vibration: the state is not stable, displacements grow as exp(t / {:.3g} s)",
      -1 / (2 * M_PI * mode.frequency_Hz));
}

/// "mode 3: 12.35 ± 0.01 Hz"; for an unstable mode an imaginary frequency, "mode 1: 0.82*i* Hz".
std::string caption_of(const record::ModeRow& mode) {
  if (mode.frequency_Hz >= 0) return fmt::format("mode {}: {}", mode.mode, frequency_text(mode));
  return fmt::format("mode {}: {:.4g}*i* Hz", mode.mode, -mode.frequency_Hz);
}

/// The text of shapes.csv: a line for each mode and joint with its displacement; the largest
/// displacement of a node is 1.
std::string shapes_csv(const Vibrations& found) {
  record::CsvWriter csv;
  csv.line("mode", "i", "j", "dx", "dy", "dz");
  for (std::size_t k = 0; k < found.modes.size(); ++k)
    for (const record::Joint& joint : found.state.layout.joints) {
      const auto move = found.shapes[k].col(joint.node);
      csv.line(found.modes[k].mode, joint.i, joint.j, move.x(), move.y(), move.z());
    }
  return std::move(csv).text();
}

/// Draws one period of a vibration, which starts in the undisplaced state.
Result<void> draw_movie(const preset::Preset& preset, const Vibrations& found, std::size_t k,
                        render::Renderer& renderer, const fs::path& folder, Watch& watch) {
  Run run{.preset = preset, .pictures = Pictures::movie};
  run.preset.movie.hold_first_s = run.preset.movie.hold_s = run.preset.movie.title_s = 0;
  run.preset.movie.captions = false;
  run.preset.movie.colour_by = preset::ColourBy::displacement;
  run.preset.movie.turn_deg = 0;
  run.trajectory.layout = found.state.layout;
  for (int n = 0; n < frames_of_cycle; ++n)
    run.trajectory.frames.push_back(
        moved_by(found.state, found.shapes[k], std::sin(2 * M_PI * n / frames_of_cycle), n));
  return draw_run(run, bar_of_moves, renderer,
                  folder / fmt::format("mode_{:02}", found.modes[k].mode), watch);
}

Result<FormedStudy> find_modes(const preset::Preset& preset, const ModesOptions& options,
                               Watch& watch) {
  TRY(of, study::vibrations_of(preset, options.count, watch));
  const auto found = std::make_shared<const Vibrations>(std::move(*of));
  FormedStudy all{
      .files = {{"modes.csv", record::csv_table(found->modes)}, {"shapes.csv", shapes_csv(*found)}},
      .state = found->state,
      .summary = found->summary};
  for (std::size_t k = 0; k < found->modes.size(); ++k) {
    all.text += fmt::format("  {:>3}  {}\n", found->modes[k].mode, frequency_text(found->modes[k]));
    all.moves.push_back(moved_by(found->state, found->shapes[k], 1, int(k)));
    all.captions.push_back(caption_of(found->modes[k]));
  }
  if (options.movies)
    all.draw_more = [preset, found](render::Renderer& renderer, const fs::path& folder,
                                    Progress& progress) -> Result<void> {
      for (std::size_t k = 0; k < found->modes.size(); ++k)
        TRY_DO(draw_movie(preset, *found, k, renderer, folder, progress.next_phase()));
      return {};
    };
  return all;
}

Result<int> study_modes(const ModesOptions& options) {
  return study_formed(
      options.common,
      {"_modes", "natural frequencies",
       [&](const preset::Preset& preset, Watch& watch) {
         return find_modes(preset, options, watch);
       },
       1, [&](const preset::Preset&) { return options.count; },
       [&](const preset::Preset& preset) {
         const double frame = expected_seconds(Pictures::movie, preset) / preset.movie.frames;
         return std::vector<Phase>(options.movies ? std::size_t(options.count) : 0,
                                   drawing("drawing movies", frames_of_cycle * frame));
       }});
}

}  // namespace

void add_load(CommandLine& program) {
  auto [command, options] = program.add<LoadOptions>(
      "load", "how much of each load case the formed shell carries, and how it fails", study_loads);
  add_preset_options(command, options.common);
  add_work_options(command, options.common, "folder to write, by default out/<preset>_load");
  add_picture_options(command, options.common);
  command
      .option("--imperfections", options.imperfections,
              "more shells per case, displaced by loads.imperfection")
      .in_range(0, 1000);
}

void add_modes(CommandLine& program) {
  auto [command, options] = program.add<ModesOptions>(
      "modes", "natural frequencies and shapes about the formed, loaded state", study_modes);
  add_preset_options(command, options.common);
  add_work_options(command, options.common, "folder to write, by default out/<preset>_modes");
  add_picture_options(command, options.common);
  command.option("--count", options.count, "number of modes, the lowest ones").in_range(1, 200);
  command.flag("--movies", options.movies, "also a movie of each mode, mode_01/movie.mp4 ...");
}

}  // namespace gridshell::app
