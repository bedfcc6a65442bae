// `gridshell load PRESET`: what a formed shell carries, case by case, as tables and pictures.

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
#include "engine/core/json.h"
#include "engine/core/try.h"
#include "engine/gridshell.h"
#include "render/movie/state_charts.h"
#include "render/movie/stills.h"

namespace gridshell::app {
namespace fs = std::filesystem;
namespace {

using record::BranchEvent;
using study::LoadStudy;

struct LoadOptions {
  Options common;
  int imperfections = 0;
};

/// "full snow: limit point at 3.42 ± 0.02 (linear 5.1), knock-down 0.84 (0.71 to 0.93)"
std::string text_of(const record::LoadRow& row) {
  std::string text = row.load_case + ": ";
  if (std::isfinite(row.critical_factor))
    text += fmt::format(
        "{} at a factor of {:.4g}{}",
        row.event == BranchEvent::turn ? "limit point" : "bifurcation", row.critical_factor,
        std::isfinite(row.error) ? fmt::format(" ± {:.1g}", row.error) : " (error not known)");
  else
    text += row.event == BranchEvent::locking ? "rods at their length before stability is lost"
                                              : "stability is not lost on the way followed";
  if (std::isfinite(row.linear_factor)) text += fmt::format(" (linear {:.4g})", row.linear_factor);
  if (row.imperfections > 0)
    text += fmt::format("; {} that are not perfect: {:.3g} of it ({:.3g} to {:.3g})",
                        row.imperfections, row.knock_down_50, row.knock_down_5, row.knock_down_95);
  return text;
}

std::string json_text(const LoadStudy& found) {
  Json cases = Json::array();
  for (const record::LoadRow& row : found.cases) cases.push_back(json_of(row));
  Json json = Json::object();
  json["cases"] = std::move(cases);
  return gridshell::text_of(json);
}

Result<void> draw(preset::Preset preset, const LoadStudy& found, const LoadOptions& options,
                  const fs::path& folder, Progress& progress) {
  const fs::path stem = folder / fs::path(preset.name).filename();
  TRY_DO(render::write_plot(stem.string() + "_factors",
                            render::load_plot(found.points, preset::title_or_name(preset)),
                            {.width_mm = 120}));
  TRY(maker, PictureMaker::create(options.common.context, preset.style.font));
  preset.movie.colour_by = preset::ColourBy::displacement;
  preset.movie.turn_deg = 0;
  record::Trajectory moves{found.state.layout, {}};
  std::vector<std::string> captions;
  for (std::size_t k = 0; k < found.cases.size(); ++k) {
    if (found.modes[k].size() == 0) continue;
    moves.frames.push_back(moved_by(found.state, found.modes[k], 1, int(k)));
    captions.push_back(
        fmt::format("{}: {:.4g}", found.cases[k].load_case, found.cases[k].critical_factor));
  }
  Watch& watch = progress.next_phase();
  if (captions.empty()) return {};
  TRY_DO(render::write_stills(moves, style_of(preset, Pictures::stills), bar_of_moves,
                              maker->renderer(), stem, watch, captions,
                              &found.state.frames.back()));
  return {};
}

Result<void> find_loads(const preset::Case& run, const LoadOptions& options, const fs::path& folder,
                        Progress& progress, std::string& text, std::string& fault) {
  auto found = study::load_study(run.preset, options.imperfections, progress.next_phase());
  if (!found) {
    found.error().message = run.preset.name + ": " + found.error().message;
    return tl::unexpected(found.error());
  }
  TRY_DO(make_folder(folder));
  TRY_DO(write_file(folder / "preset.toml", preset::to_toml(run.preset)));
  TRY_DO(write_file(folder / "load.csv", record::csv_table(found->points)));
  TRY_DO(write_file(folder / "cases.csv", record::csv_table(found->cases)));
  TRY_DO(write_file(folder / "load.json", json_text(*found)));
  found->summary.kind = record::Kind::figure;
  TRY_DO(record::write_summary(folder / "summary.json", found->summary));
  if (!run.name.empty()) text += run.name + ":\n";
  for (const record::LoadRow& row : found->cases) text += "  " + text_of(row) + "\n";
  if (const auto why = failure_of(found->summary, run.preset.allow_unstable); !why.empty())
    fault += fmt::format("{}: {}\n", run.preset.name, why);
  return draw(run.preset, *found, options, folder, progress);
}

Result<int> load(const LoadOptions& options) {
  TRY(presets, app::load(options.common));
  if (options.common.print_config) return print_config(*presets);
  const auto runs = runs_of(*presets);
  const auto folder = output_of(options.common, presets->base, "_load");
  std::vector<Phase> phases;
  for (const auto& run : runs) {
    TRY(plan, plan_of(run.preset));
    const double still = expected_seconds(Pictures::stills, run.preset);
    phases.push_back(
        {"following loads", std::isnan(plan->expected_seconds) ? 1 : 4 * plan->expected_seconds});
    phases.push_back(drawing("drawing", still * double(run.preset.load_case.size())));
  }
  std::string text, fault;
  TRY_DO(deliver(folder, phases, options.common.quiet,
                 [&](const fs::path& partial, Progress& progress) -> Result<void> {
                   for (const auto& run : runs)
                     TRY_DO(find_loads(run, options, folder_of(partial, run.name), progress, text,
                                       fault));
                   return {};
                 }));
  if (!options.common.quiet) fmt::print("{}: load factors\n{}", folder.string(), text);
  fmt::print(stderr, "{}", fault);
  return fault.empty() ? ExitCode::done : ExitCode::failed;
}

}  // namespace

void add_load(CommandLine& program) {
  const auto options = std::make_shared<LoadOptions>();
  CommandArguments command =
      program.add("load", "how much of each load case the formed shell carries, and how it fails",
                  [options] { return load(*options); });
  add_preset_options(command, options->common);
  add_work_options(command, options->common, "folder to write, by default out/<preset>_load");
  add_picture_options(command, options->common);
  command
      .option("--imperfections", options->imperfections,
              "shells more a case whose shape is off by loads.imperfection")
      .in_range(0, 1000);
}

}  // namespace gridshell::app
