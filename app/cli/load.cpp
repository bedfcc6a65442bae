// `gridshell load PRESET`: what a formed shell carries, case by case, as tables and pictures.

#include <fmt/format.h>
#include <cmath>
#include <memory>

#include "app/cli/commands.h"
#include "app/cli/formed_study.h"
#include "engine/core/json.h"
#include "engine/core/try.h"
#include "engine/gridshell.h"
#include "render/movie/state_charts.h"

namespace gridshell::app {
namespace fs = std::filesystem;
namespace {

using record::BranchEvent;
using study::LoadStudy;

struct LoadOptions {
  Options common;
  int imperfections = 0;
};

/// "full snow: limit point at 3.42 ± 0.02 (linear 5.1); at its strength at 1.2 ± 0.01; 20 that are
/// not perfect: 0.84 of it (0.71 to 0.93)"
std::string text_of(const record::LoadRow& row) {
  std::string text = row.load_case + ": ";
  if (std::isfinite(row.critical_factor))
    text += fmt::format("{} at a factor of {}",
                        row.event == BranchEvent::turn ? "limit point" : "bifurcation",
                        record::with_error(row.critical_factor, row.error, ""));
  else
    text += row.event == BranchEvent::locking ? "rods at their length before stability is lost"
                                              : "stability is not lost on the way followed";
  if (std::isfinite(row.linear_factor)) text += fmt::format(" (linear {:.4g})", row.linear_factor);
  if (row.strength_factor == 0)
    text += "; beyond its strength before any of it";
  else if (std::isfinite(row.strength_factor))
    text +=
        "; at its strength at " + record::with_error(row.strength_factor, row.strength_error, "");
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

Result<FormedStudy> find_loads(const preset::Preset& preset, int imperfections, Watch& watch) {
  TRY(found, study::load_study(preset, imperfections, watch));
  FormedStudy all{{{"load.csv", record::csv_table(found->points)},
                   {"cases.csv", record::csv_table(found->cases)},
                   {"load.json", json_text(*found)}},
                  "",
                  found->state,
                  found->summary,
                  {},
                  {}};
  for (std::size_t k = 0; k < found->cases.size(); ++k) {
    const record::LoadRow& row = found->cases[k];
    all.text += "  " + text_of(row) + "\n";
    if (found->modes[k].size() == 0) continue;
    record::Frame moved = moved_by(found->state, found->modes[k], 1, int(k));
    moved.loads_N = row.critical_factor * found->loads[k];
    all.moves.push_back(std::move(moved));
    all.captions.push_back(fmt::format("{}: {:.4g}", row.load_case, row.critical_factor));
  }
  const auto plot = render::load_plot(found->points, found->cases, preset::title_or_name(preset));
  all.draw_more = [plot, name = fs::path(preset.name).filename().string()](
                      render::Renderer&, const fs::path& folder, Progress&) {
    return render::write_plot((folder / name).string() + "_factors", plot, {.width_mm = 120});
  };
  return all;
}

Result<int> load(const LoadOptions& options) {
  return study_formed(
      options.common,
      {"_load", "load factors",
       [&](const preset::Preset& preset, Watch& watch) {
         return find_loads(preset, options.imperfections, watch);
       },
       4, [](const preset::Preset& preset) { return int(preset.load_case.size()); }});
}

}  // namespace

void add_load(CommandLine& program) {
  auto [command, options] = program.add<LoadOptions>(
      "load", "how much of each load case the formed shell carries, and how it fails", load);
  add_preset_options(command, options.common);
  add_work_options(command, options.common, "folder to write, by default out/<preset>_load");
  add_picture_options(command, options.common);
  command
      .option("--imperfections", options.imperfections,
              "shells more a case whose shape is off by loads.imperfection")
      .in_range(0, 1000);
}

}  // namespace gridshell::app
