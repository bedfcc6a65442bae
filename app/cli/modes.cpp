// `gridshell modes PRESET`: how a formed shell vibrates, as a table and as pictures.

#include <fmt/format.h>
#include <cmath>
#include <memory>

#include "app/cli/commands.h"
#include "app/cli/console.h"
#include "app/cli/delivery.h"
#include "app/cli/pictures.h"
#include "app/cli/preset_library.h"
#include "app/cli/produce.h"
#include "engine/core/file_io.h"
#include "engine/core/try.h"
#include "engine/gridshell.h"
#include "render/movie/stills.h"

namespace gridshell::app {
namespace fs = std::filesystem;
namespace {

using study::Vibrations;

constexpr int frames_of_cycle = 24;

struct ModesOptions {
  Options common;
  int count = 12;
  bool movies = false;
};

std::string frequency_text(const record::ModeRow& mode) {
  if (mode.frequency_Hz >= 0) return record::with_error(mode.frequency_Hz, mode.error_Hz, "Hz");
  return fmt::format("no vibration: the state is not stable, it leaves as exp(t / {:.3g} s)",
                     -1 / (2 * M_PI * mode.frequency_Hz));
}

/// "mode 3: 12.35 Hz", of a state that is not stable "mode 1: 0.82*i* Hz".
std::string caption_of(const record::ModeRow& mode) {
  return fmt::format("mode {}: {:.4g}{} Hz", mode.mode, std::abs(mode.frequency_Hz),
                     mode.frequency_Hz < 0 ? "*i*" : "");
}

/// A line a joint and mode: how it moves, the node that moves furthest by 1.
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

/// One vibration, from rest to rest.
Result<void> draw_movie(const preset::Preset& preset, const Vibrations& found, std::size_t k,
                        render::Renderer& renderer, const fs::path& folder, Watch& watch) {
  Run run{.preset = preset, .pictures = Pictures::movie};
  run.preset.title = preset.title + ", " + render::plain(caption_of(found.modes[k]));
  run.preset.movie.hold_s = run.preset.movie.title_s = 0;
  run.preset.movie.captions = false;
  run.trajectory.layout = found.state.layout;
  for (int n = 0; n < frames_of_cycle; ++n)
    run.trajectory.frames.push_back(
        moved_by(found.state, found.shapes[k], std::sin(2 * M_PI * n / frames_of_cycle), n));
  return draw_run(run, bar_of_moves, renderer,
                  folder / fmt::format("mode_{:02}", found.modes[k].mode), watch);
}

Result<void> draw(preset::Preset preset, const Vibrations& found, const ModesOptions& options,
                  const fs::path& folder, Progress& progress) {
  TRY(maker, PictureMaker::create(options.common.context, preset.style.font));
  preset.movie.colour_by = preset::ColourBy::displacement;
  preset.movie.turn_deg = 0;
  record::Trajectory moves{found.state.layout, {}};
  std::vector<std::string> captions;
  for (std::size_t k = 0; k < found.modes.size(); ++k) {
    moves.frames.push_back(moved_by(found.state, found.shapes[k], 1, int(k)));
    captions.push_back(caption_of(found.modes[k]));
  }
  const auto style = style_of(preset, Pictures::stills);
  TRY_DO(render::write_stills(moves, style, bar_of_moves, maker->renderer(),
                              folder / fs::path(preset.name).filename(), progress.next_phase(),
                              captions, &found.state.frames.back()));
  for (std::size_t k = 0; options.movies && k < found.modes.size(); ++k)
    TRY_DO(draw_movie(preset, found, k, maker->renderer(), folder, progress.next_phase()));
  return {};
}

/// One run's folder. What is said of it on the terminal is added to `text`, why it is none that
/// was asked for to `fault`.
Result<void> find_modes(const preset::Case& run, const ModesOptions& options,
                        const fs::path& folder, Progress& progress, std::string& text,
                        std::string& fault) {
  auto found = study::vibrations_of(run.preset, options.count, progress.next_phase());
  if (!found) {
    found.error().message = run.preset.name + ": " + found.error().message;
    return tl::unexpected(found.error());
  }
  TRY_DO(make_folder(folder));
  TRY_DO(write_file(folder / "preset.toml", preset::to_toml(run.preset)));
  TRY_DO(write_file(folder / "modes.csv", record::csv_table(found->modes)));
  TRY_DO(write_file(folder / "shapes.csv", shapes_csv(*found)));
  found->summary.kind = record::Kind::figure;
  TRY_DO(record::write_summary(folder / "summary.json", found->summary));
  if (!run.name.empty()) text += run.name + ":\n";
  for (const record::ModeRow& mode : found->modes)
    text += fmt::format("  {:>3}  {}\n", mode.mode, frequency_text(mode));
  if (const auto why = failure_of(found->summary, run.preset.allow_unstable); !why.empty())
    fault += fmt::format("{}: {}\n", run.preset.name, why);
  return draw(run.preset, *found, options, folder, progress);
}

Result<int> modes(const ModesOptions& options) {
  TRY(presets, load(options.common));
  if (options.common.print_config) return print_config(*presets);
  const auto runs = runs_of(*presets);
  const auto folder = output_of(options.common, presets->base, "_modes");
  std::vector<Phase> phases;
  for (const auto& run : runs) {
    TRY(plan, plan_of(run.preset));
    const double still = expected_seconds(Pictures::stills, run.preset);
    phases.push_back(
        {"finding modes", std::isnan(plan->expected_seconds) ? 1 : plan->expected_seconds});
    phases.push_back(drawing("drawing", options.count * still));
    const double frame = expected_seconds(Pictures::movie, run.preset) / run.preset.movie.frames;
    for (int k = 0; options.movies && k < options.count; ++k)
      phases.push_back(drawing("drawing movies", frames_of_cycle * frame));
  }
  std::string text, fault;
  TRY_DO(deliver(folder, phases, options.common.quiet,
                 [&](const fs::path& partial, Progress& progress) -> Result<void> {
                   for (const auto& run : runs)
                     TRY_DO(find_modes(run, options, folder_of(partial, run.name), progress, text,
                                       fault));
                   return {};
                 }));
  if (!options.common.quiet) fmt::print("{}: natural frequencies\n{}", folder.string(), text);
  fmt::print(stderr, "{}", fault);
  return fault.empty() ? ExitCode::done : ExitCode::failed;
}

}  // namespace

void add_modes(CommandLine& program) {
  const auto options = std::make_shared<ModesOptions>();
  CommandArguments command =
      program.add("modes", "natural frequencies and shapes about the formed, loaded state",
                  [options] { return modes(*options); });
  add_preset_options(command, options->common);
  add_work_options(command, options->common, "folder to write, by default out/<preset>_modes");
  add_picture_options(command, options->common);
  command.option("--count", options->count, "how many, from the lowest on").in_range(1, 200);
  command.flag("--movies", options->movies, "a movie a mode too, in mode_01/movie.mp4 ...");
}

}  // namespace gridshell::app
