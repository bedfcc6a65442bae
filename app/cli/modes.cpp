// `gridshell modes PRESET`: how a formed shell vibrates, as a table and as pictures.

#include <fmt/format.h>
#include <cmath>
#include <memory>

#include "app/cli/commands.h"
#include "app/cli/formed_study.h"
#include "engine/core/try.h"
#include "engine/gridshell.h"

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
      {{"modes.csv", record::csv_table(found->modes)}, {"shapes.csv", shapes_csv(*found)}},
      "",
      found->state,
      found->summary,
      {},
      {}};
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

Result<int> modes(const ModesOptions& options) {
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

void add_modes(CommandLine& program) {
  auto [command, options] = program.add<ModesOptions>(
      "modes", "natural frequencies and shapes about the formed, loaded state", modes);
  add_preset_options(command, options.common);
  add_work_options(command, options.common, "folder to write, by default out/<preset>_modes");
  add_picture_options(command, options.common);
  command.option("--count", options.count, "how many, from the lowest on").in_range(1, 200);
  command.flag("--movies", options.movies, "a movie a mode too, in mode_01/movie.mp4 ...");
}

}  // namespace gridshell::app
