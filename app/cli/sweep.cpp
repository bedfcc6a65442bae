// `gridshell sweep`: many runs of one preset. A log has a line for each point; results are gathered
// and drawn.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cstdio>
#include <set>
#include <string>

#include "app/cli/command_line.h"
#include "app/cli/commands.h"
#include "app/cli/console.h"
#include "app/cli/delivery.h"
#include "app/cli/preset_library.h"
#include "app/cli/staged_folder.h"
#include "app/cli/sweep_folder.h"
#include "engine/core/file_io.h"
#include "engine/core/parallel.h"
#include "engine/core/text.h"
#include "engine/core/try.h"
#include "engine/gridshell.h"
#include "render/movie/state_charts.h"
#include "render/movie/sweep_chart.h"

namespace gridshell::app {
namespace fs = std::filesystem;
namespace {

struct SweepOptions {
  Options common;
  int jobs = 0;       ///< points computed at a time; 0: as many as there are cores
  std::string shard;  ///< "i/N": every N-th point from the i-th on, in DIR/shard_i_of_N; empty: all
  bool merge = false;  ///< gather the shards in DIR instead of computing
};

constexpr double chart_width_mm = 130, chart_height = 0.62;  // height over width
constexpr const char* classes = "classes";  // the picture of the classes of states that were found
constexpr const char* laws_name = "laws.csv";

/// A sweep that is running.
struct SweepJob {
  const SweepOptions& options;
  const preset::Presets& presets;
  const preset::SweepGrid& grid;
  fs::path folder;
  std::optional<Shard> shard;

  bool quiet() const { return options.common.quiet; }
  std::vector<std::size_t> points() const {
    const Shard part = shard.value_or(Shard{});
    return study::points_of_shard(grid.size(), part.index, part.count);
  }
};

std::vector<std::string> plots_of(const preset::SweepGrid& grid) {
  const auto& plots = grid.sweep().plot;
  return plots.empty() ? std::vector<std::string>{"height_mm"} : plots;
}

/// The names of what can be drawn: the figures of a point, and `classes` for searches for states
/// over leg and rods.
std::vector<std::string> drawable(const preset::Presets& presets, const preset::SweepGrid& grid) {
  std::set<std::string> names;
  for (const auto& run : runs_of(presets)) {
    const bool search = run.preset.jitter.requested();
    for (auto& name : study::figure_names(search)) names.insert(std::move(name));
    if (search && record::makes_phase_diagram(axes_of(grid))) names.insert(classes);
  }
  return {names.begin(), names.end()};
}

/// Checks that there is something to sweep and that the requested figures exist. Errors: bad_input.
Result<void> check_request(const preset::Presets& presets, const preset::SweepGrid& grid) {
  if (grid.size() == 0)
    return invalid(
        "{}: sweeps nothing: expected [sweep] over or seeds, for example --set "
        "'sweep.over={{rod.diameter_mm=[0.2,0.3]}}'",
        presets.base.name);
  const std::size_t keys = axes_of(grid).size();
  if (keys == 2 && (!grid.sweep().x.empty() || grid.sweep().departure > 0))
    return invalid("{}: [sweep] x and departure have no effect on the map of two keys",
                   presets.base.name);
  if (keys > 2 && !grid.sweep().plot.empty())
    return invalid("{}: [sweep] plot: got {} keys, expected 1 for a chart or 2 for a map",
                   presets.base.name, keys);
  const auto names = drawable(presets, grid);
  auto requested = plots_of(grid);
  if (!grid.sweep().x.empty()) requested.push_back(grid.sweep().x);
  for (const auto& name : requested)
    if (std::ranges::find(names, name) == names.end())
      return invalid(
          "{}: [sweep] plot or x = \"{}\": is no figure of a run{}", presets.base.name, name,
          name == classes
              ? ", only of searches for states over footprint.longest_leg and footprint.rods alone"
              : did_you_mean(name, names) + fmt::format("; there are {}", fmt::join(names, ", ")));
  return {};
}

/// The picture of the classes of a case, without its extension.
fs::path classes_stem(const SweepJob& work, const preset::Case& run) {
  return work.folder / (run.name.empty() ? classes : run.name + "_" + classes);
}

/// Removes what an earlier call drew and this one does not request, and all power laws, which are
/// written again.
void remove_other_pictures(const SweepJob& work) {
  std::error_code error;
  const auto remove = [&](const fs::path& stem, std::initializer_list<const char*> ends) {
    for (const char* end : ends) fs::remove(fs::path(stem) += end, error);
  };
  const auto drawn = plots_of(work.grid);
  fs::remove(work.folder / laws_name, error);
  for (const auto& name : drawable(work.presets, work.grid)) {
    remove(work.folder / name, {"_law.png", "_law.svg", "_law.pdf"});
    if (std::ranges::find(drawn, name) != drawn.end()) continue;
    remove(work.folder / name, {".png", ".svg", ".pdf"});
    if (name != classes) continue;
    for (const auto& run : runs_of(work.presets))
      remove(classes_stem(work, run), {".png", ".svg", ".pdf", "_by_leg.csv"});
  }
}

/// Writes for each case the phase diagram and a table of its regions, to compare with the paper.
Result<void> draw_classes(const SweepJob& work, const record::SweepTable& table,
                          const render::Print& print) {
  for (const auto& run : runs_of(work.presets)) {
    const auto stem = classes_stem(work, run);
    const auto diagram = record::phase_diagram_of(table, run.name);
    TRY_DO(render::write_phase_chart(stem, diagram, run.preset.title, print));
    TRY_DO(write_file(fs::path(stem) += "_by_leg.csv",
                      record::csv_table(record::regions_of(diagram))));
  }
  return {};
}

Result<void> draw(const SweepJob& work, const record::SweepTable& table) {
  const preset::Preset& base = work.presets.base;
  for (const auto& name : plots_of(work.grid)) {
    const render::SweepView view{name, base.sweep.x, base.sweep.departure, base.title};
    const auto stem = work.folder / name;
    const render::Print print{base.figure.width_mm > 0 ? base.figure.width_mm : chart_width_mm,
                              base.figure.dpi};
    if (name == classes)
      TRY_DO(draw_classes(work, table, print));
    else if (table.axes.size() == 2)
      TRY_DO(render::write_sweep_map(stem, table, view, print));
    else
      TRY_DO(render::write_plot(stem, render::sweep_plot(table, view), print, chart_height));
  }
  return {};
}

/// Writes the power laws of the figures that are drawn, as laws.csv and pictures; returns them as
/// lines of text.
Result<std::string> write_laws(const SweepJob& work, const record::SweepTable& table) {
  std::string text;
  std::vector<record::LawRow> rows;
  for (const auto& name : plots_of(work.grid)) {
    std::vector<record::PowerLaw> laws;
    for (const auto& run : runs_of(work.presets))
      if (auto law = record::power_law(table, run.name, name); law && law->is_confirmed())
        laws.push_back(std::move(*law));
    for (const record::PowerLaw& law : laws) {
      text += fmt::format("\n  {}{}{}", law.keys.front().case_name,
                          law.keys.front().case_name.empty() ? "" : ", ", name);
      for (const record::LawRow& key : law.keys) {
        text += fmt::format(", {}^({:.3f} ± {:.3f})", key.key, key.exponent, key.error);
        rows.push_back(key);
      }
      text += fmt::format(" within {:.1g} %", 100 * law.scatter);
    }
    if (laws.empty()) continue;
    TRY_DO(render::write_plot(work.folder / (name + "_law"),
                              render::law_plot(laws, {name, "", 0, work.presets.base.title}),
                              {.width_mm = chart_width_mm}, chart_height));
  }
  if (!rows.empty()) TRY_DO(write_file(work.folder / laws_name, record::csv_table(rows)));
  return text;
}

/// "20 points: 18 done, 2 of them ended early (locking), 1 of them not stable; 2 without an
/// equilibrium"
std::string reported(const record::SweepTable& table) {
  int done = 0, limited = 0, unstable = 0, none = 0, refused = 0;
  std::set<std::string> limits;
  for (const auto& row : table.rows) {
    const auto& result = row.result;
    done += result.outcome == record::PointOutcome::done;
    none += result.outcome == record::PointOutcome::no_equilibrium;
    refused += result.outcome == record::PointOutcome::refused;
    unstable += render::is_unstable(row);
    if (const std::string limit = render::limit_of(row); !limit.empty()) {
      ++limited;
      limits.insert(limit);
    }
  }
  auto text = fmt::format("{}: {} done", counted(table.rows.size(), "point"), done);
  if (limited > 0)
    text += fmt::format(", {} of them ended early ({})", limited, fmt::join(limits, ", "));
  if (unstable > 0) text += fmt::format(", {} of them not stable", unstable);
  if (none > 0) text += fmt::format("; {} without an equilibrium", none);
  if (refused > 0) text += fmt::format("; {} refused", refused);
  return text;
}

/// A line for each region of the phase diagram: "  l_d > 1: 24 points; domes ...".
std::string regions_text(const SweepJob& work, const record::SweepTable& table) {
  using record::StateClass;
  std::string text;
  for (const auto& run : runs_of(work.presets))
    for (const auto& region : record::regions_of(record::phase_diagram_of(table, run.name))) {
      if (region.points == 0) continue;
      const auto with = [&](StateClass kind) { return region.with[std::size_t(kind)]; };
      text += fmt::format(
          "\n  {}{}{}: {} points; domes of first-mode buckling alone at {}, in which {} of {} "
          "trials "
          "end; several states at {}, broken symmetry at {}; i at {}, ii at {}, iii at {}, iv at "
          "{}; more states than the paper drew at {} ({})",
          run.name, run.name.empty() ? "" : ", ", record::name_of(region), region.points,
          region.first_order_alone, region.met_first_order, region.at_rest, region.several_states,
          region.symmetry_broken, with(StateClass::i), with(StateClass::ii), with(StateClass::iii),
          with(StateClass::iv), region.with_more_than_paper, region.states_more);
    }
  return text;
}

Result<std::string> finish(const SweepJob& work, const record::SweepLog& log) {
  const auto table = table_of(work.grid, work.points(), log.found());
  TRY_DO(write_file(work.folder / sweep_table_name, record::sweep_csv(table)));
  TRY_DO(write_file(work.folder / "preset.toml", saved_preset(preset::to_toml(work.presets))));
  std::string laws;
  // a shard has too few points for a picture
  if (!work.shard) {
    remove_other_pictures(work);
    if (table.axes.size() <= 2) TRY_DO(draw(work, table));
    TRY(text, write_laws(work, table));
    laws = std::move(*text);
  }
  TRY_DO(write_manifest(work.folder, "sweep"));
  const bool any = std::ranges::any_of(
      table.rows, [](const auto& row) { return row.result.outcome == record::PointOutcome::done; });
  if (!any && !work.shard)
    return fail(Fault::no_equilibrium, "no point reached a state; the first: {}",
                table.rows.front().result.reason);
  const auto plots = plots_of(work.grid);
  const bool diagram = !work.shard && std::ranges::find(plots, classes) != plots.end();
  return reported(table) + laws + (diagram ? regions_text(work, table) : "");
}

void report_damage(const SweepJob& work, const record::SweepLog& log) {
  const auto file = (work.folder / record::sweep_log_name).string();
  if (log.cut_off())
    std::fprintf(stderr, "the last line of '%s' was cut off and is dropped\n", file.c_str());
  if (log.damaged() > 0)
    std::fprintf(stderr, "%zu line%s of '%s' damaged: what they contained is computed again\n",
                 log.damaged(), log.damaged() == 1 ? " is" : "s are", file.c_str());
}

std::vector<std::size_t> missing(const SweepJob& work, const record::SweepLog& log) {
  auto points = work.points();
  std::erase_if(points, [&](std::size_t point) { return log.found().contains(point); });
  return points;
}

std::string progress_of(const SweepJob& work, const record::SweepLog& log) {
  const auto all = work.points().size();
  return fmt::format("{} of {} points are in '{}'", all - missing(work, log).size(), all,
                     work.folder.string());
}

/// Computes the points that the log does not have.
Result<void> compute(const SweepJob& work, record::SweepLog& log) {
  const auto todo = missing(work, log);
  if (todo.empty()) return {};
  if (!work.quiet() && todo.size() < work.points().size())
    std::fprintf(stderr, "continuing: %s\n", progress_of(work, log).c_str());
  const int jobs = thread_count(work.options.jobs);
  Result<void> done;
  {
    // nothing to clean up: the log is complete whenever the program ends
    Progress progress({{"sweeping", 100}}, Progress::show_for(work.quiet()), [] {
      std::fputs("stopped: what was finished is in the log; the same command continues it\n",
                 stderr);
    });
    done = study::run_points(
        work.grid, todo, jobs, [&](record::PointResult result) { return log.append(result); },
        progress.next_phase());
  }
  if (!done && done.error().fault == Fault::cancelled)
    done.error().message = "stopped: " + progress_of(work, log) + "; the same command continues it";
  return done;
}

Result<std::string> carry_out(const SweepJob& work) {
  TRY(log, open_sweep(work.folder, work.presets, work.grid));
  report_damage(work, *log);
  if (work.options.merge) {
    TRY_DO(gather_shards(work.folder, *log, work.presets, work.grid));
    if (!missing(work, *log).empty())
      return fail(Fault::no_equilibrium,
                  "{}; shards continue where they stopped, and without --merge the remaining runs "
                  "are computed here",
                  progress_of(work, *log));
  } else {
    TRY_DO(compute(work, *log));
  }
  return finish(work, *log);
}

Result<int> sweep(const SweepOptions& options) {
  TRY(presets, load(options.common));
  if (options.common.print_config) return print_config(*presets);
  const preset::SweepGrid grid(*presets);
  TRY_DO(check_request(*presets, grid));
  SweepJob work{options, *presets, grid, output_of(options.common, presets->base), std::nullopt};
  if (!options.shard.empty()) {
    TRY(shard, parse_shard(options.shard));
    work.shard = *shard;
    work.folder /= shard->folder();
  }
  const InterruptGuard guarded;
  TRY(done, carry_out(work));
  if (!options.common.quiet) fmt::print("{}: {}\n", work.folder.string(), *done);
  return ExitCode::done;
}

}  // namespace

Result<void> check_sweep(const preset::Presets& presets) {
  return check_request(presets, preset::SweepGrid(presets));
}

// `gridshell sweep PRESET`: many runs of one preset, resumable, on several cores or machines.

void add_sweep(CommandLine& program) {
  auto [command, options] =
      program.add<SweepOptions>("sweep", "many runs of one preset, resumable, parallel", sweep);
  add_preset_options(command, options.common);
  add_work_options(command, options.common);
  command
      .option("--jobs", options.jobs,
              "points computed at a time, by default as many as there are cores; results do "
              "not change")
      .in_range(1, 1024);
  const auto shard =
      command.option("--shard", options.shard, "i/N: every N-th point, in DIR/shard_i_of_N");
  command.flag("--merge", options.merge, "gather the shards in DIR instead of computing")
      .excludes(shard);
}

}  // namespace gridshell::app
