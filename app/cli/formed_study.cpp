#include "app/cli/formed_study.h"

#include <fmt/format.h>
#include <cmath>

#include "app/cli/console.h"
#include "app/cli/preset_library.h"
#include "app/cli/produce.h"
#include "engine/core/file_io.h"
#include "engine/core/try.h"
#include "render/movie/stills.h"

namespace gridshell::app {
namespace fs = std::filesystem;
namespace {

Result<void> draw(preset::Preset preset, const FormedStudy& found, const std::string& context,
                  const fs::path& folder, Progress& progress) {
  TRY(maker, PictureMaker::create(context, preset.style.font));
  preset.movie.colour_by = preset::ColourBy::displacement;
  preset.movie.turn_deg = 0;
  Watch& watch = progress.next_phase();
  if (!found.moves.empty())
    TRY_DO(render::write_stills({found.state.layout, found.moves},
                                style_of(preset, Pictures::stills), bar_of_moves, maker->renderer(),
                                folder / fs::path(preset.name).filename(), watch, found.captions,
                                &found.state.frames.back()));
  if (!found.draw_more) return {};
  return found.draw_more(maker->renderer(), folder, progress);
}

/// One run's folder. What is said of it on the terminal is added to `text`, why it is none that
/// was asked for to `fault`.
Result<void> study_one(const preset::Case& run, const FormedCommand& command,
                       const std::string& context, const fs::path& folder, Progress& progress,
                       std::string& text, std::string& fault) {
  auto found = command.find(run.preset, progress.next_phase());
  if (!found) {
    found.error().message = run.preset.name + ": " + found.error().message;
    return tl::unexpected(found.error());
  }
  TRY_DO(make_folder(folder));
  TRY_DO(write_file(folder / "preset.toml", preset::to_toml(run.preset)));
  for (const auto& [name, content] : found->files) TRY_DO(write_file(folder / name, content));
  found->summary.kind = record::Kind::figure;
  TRY_DO(record::write_summary(folder / "summary.json", found->summary));
  if (!run.name.empty()) text += run.name + ":\n";
  text += found->text;
  if (const auto why = failure_of(found->summary, run.preset.allow_unstable); !why.empty())
    fault += fmt::format("{}: {}\n", run.preset.name, why);
  return draw(run.preset, *found, context, folder, progress);
}

}  // namespace

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
  TRY_DO(deliver(folder, phases, options.quiet,
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

}  // namespace gridshell::app
