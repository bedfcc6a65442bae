// The work behind `chart`: studies of methods, their tables and pictures.

#include <fmt/format.h>
#include <map>

#include "app/cli/commands.h"
#include "app/cli/console.h"
#include "app/cli/delivery.h"
#include "app/cli/preset_library.h"
#include "engine/core/file_io.h"
#include "engine/core/json.h"
#include "engine/core/text.h"
#include "engine/core/try.h"
#include "engine/gridshell.h"
#include "render/movie/state_charts.h"
#include "render/movie/validation_charts.h"

namespace gridshell::app {
namespace fs = std::filesystem;
namespace {

using record::BranchEvent;
using record::BranchPoint;

/// What to chart and how much to spend on it.
struct ChartOptions {
  Options common;
  std::string kind;    ///< "accuracy", "stability" or "branches"
  double limit_s = 0;  ///< seconds after which a run is too slow; 0: the default of the study
  int edges = 32;      ///< edges per segment of the finest mesh of the methods
  std::string sizes;   ///< for `accuracy`: rods per direction, "12,24,48"
};

/// Lines for the terminal once everything is written, and the summary of a study.
struct ChartReport {
  std::string text;
  Json summary = Json::object();
};

std::string position_text(const BranchPoint& point, double original_radius_mm) {
  if (!std::isfinite(point.boundary_radius_mm))
    return fmt::format("progress {:.4f}", point.progress);
  return fmt::format("R_a = {:.4f} R_o", point.boundary_radius_mm / original_radius_mm);
}

/// Appends a line for each branch: "branch 1: 88 points, 80 of them stable; bifurcation at ...".
void append_branches(const study::BranchDiagram& diagram, ChartReport& findings) {
  const auto& points = diagram.points;
  const int last = points.empty() ? -1 : points.back().branch;
  for (int branch = 0; branch <= last; ++branch) {
    int count = 0, stable = 0;
    std::string events;
    for (const BranchPoint& point : points) {
      if (point.branch != branch) continue;
      ++count;
      stable += point.stable();
      if (point.event != BranchEvent::none)
        events += fmt::format("; {} at {}", word_of(point.event),
                              position_text(point, diagram.original_radius_mm));
    }
    findings.text += fmt::format("{}: {} points, {} of them stable{}\n",
                                 branch == 0 ? "the path" : fmt::format("branch {}", branch), count,
                                 stable, events);
  }
}

/// Writes branches.csv and branches.png, .svg, .pdf.
Result<ChartReport> draw_branches(const preset::Preset& preset, const fs::path& folder,
                                  Watch& watch) {
  TRY(found, study::branches_study(preset, {}, watch));
  TRY_DO(write_file(folder / "branches.csv", record::csv_table(found->points)));
  TRY_DO(render::write_branches(folder / "branches", found->points, preset.title));
  ChartReport findings;
  findings.summary = {{"edges_per_segment", found->edges_per_segment},
                      {"branches", found->points.empty() ? 0 : found->points.back().branch + 1},
                      {"symmetry_order", found->symmetry_order},
                      {"all_followed", found->all_followed}};
  findings.text = fmt::format(
      "on {} edges per segment; the path has {} of the 8 symmetries of the square, and the "
      "amplitude is of the displacement that breaks them\n",
      found->edges_per_segment, found->symmetry_order);
  append_branches(*found, findings);
  if (!found->all_followed) findings.text += "not all branches were followed to their ends\n";
  return findings;
}

/// The options of a study of methods, with the time and threads that the user allows.
template <class StudyOptions>
StudyOptions limited(const ChartOptions& options) {
  StudyOptions how;
  if (options.limit_s > 0) how.seconds = options.limit_s;
  if (options.common.threads > 0) how.threads = options.common.threads;
  return how;
}

// width of the plots, and heights as fractions of it
constexpr double wide_mm = 178, high = 105 / wide_mm, low = 80 / wide_mm;

/// "12,24,48" as numbers of rods. Errors: bad_input.
Result<std::vector<int>> sizes_in(const std::string& text) {
  std::vector<int> sizes;
  for (const std::string_view word : words_in(text, ",")) {
    const auto rods = parse_number<int>(word);
    if (!rods || *rods < 4 || *rods > 400)
      return invalid("--sizes {}: '{}' is no number of rods from 4 to 400", text, word);
    sizes.push_back(*rods);
  }
  if (sizes.empty()) return invalid("--sizes {}: expected at least one number of rods", text);
  return sizes;
}

/// Writes accuracy.csv, .png, .svg and .pdf, with one curve for each size of the shell.
Result<ChartReport> draw_sizes(const preset::Preset& preset, const ChartOptions& options,
                               const fs::path& folder, Watch& watch) {
  auto how = limited<study::AccuracyOptions>(options);
  how.finest = options.edges;
  TRY(sizes, sizes_in(options.sizes));
  TRY(rows, study::sizes_study(preset, *sizes, how, watch));
  TRY_DO(write_file(folder / "accuracy.csv", record::csv_table(*rows)));
  const std::string title =
      render::plain(preset.title) + ": error over time, by rods per direction";
  TRY_DO(render::write_plot(folder / "accuracy", render::accuracy_plot(*rows, title, true),
                            {wide_mm}, high));
  ChartReport findings;
  for (const auto& row : *rows)
    findings.text +=
        fmt::format("{}: {} edges per segment, error {:.1e} in {:.3f} s ({})\n", row.method,
                    row.edges_per_segment, row.error, row.cpu_s, word_of(row.outcome));
  return findings;
}

Result<ChartReport> draw_accuracy(const preset::Preset& preset, const ChartOptions& options,
                                  const fs::path& folder, Watch& watch) {
  if (!options.sizes.empty()) return draw_sizes(preset, options, folder, watch);
  auto how = limited<study::AccuracyOptions>(options);
  how.most_edges = options.edges;
  how.finest = 4 * options.edges;
  TRY(found, study::accuracy_study(preset, how, watch));
  const std::string title = render::plain(preset.title);
  const auto plot = [&](const char* name, const render::Plot& drawn, double height) {
    return render::write_plot(folder / name, drawn, {wide_mm}, height);
  };
  TRY_DO(write_file(folder / "accuracy.csv", record::csv_table(found->rows)));
  TRY_DO(write_file(folder / "scaling.csv", record::csv_table(found->scaling)));
  TRY_DO(plot("accuracy", render::accuracy_plot(found->rows, title + ": error over time"), high));
  TRY_DO(
      plot("unknowns", render::unknowns_plot(found->rows, title + ": error over unknowns"), high));
  TRY_DO(plot("scaling", render::scaling_plot(found->scaling, title + ": time over size"), low));
  ChartReport findings;
  findings.summary["reference_error"] = found->reference_error;
  for (const auto& at : found->outcomes) {
    findings.text += fmt::format(
        "auto at {:.0e}: error {:.1e} in {:.3f} s, {:.2f} times as long as the fastest method that "
        "is as accurate, {:.2f} times as long as the fastest within the tolerance\n",
        at.tolerance, at.error, at.cpu_s, at.cpu_s / at.front_s, at.cpu_s / at.tolerance_s);
    findings.summary["auto"].push_back({{"tolerance", at.tolerance},
                                        {"error", at.error},
                                        {"cpu_s", at.cpu_s},
                                        {"over_front", at.cpu_s / at.front_s},
                                        {"over_asked", at.cpu_s / at.tolerance_s}});
  }
  int silent = 0;
  for (const auto& row : found->rows) silent += record::silently_wrong(row.outcome);
  findings.summary["silently_wrong"] = silent;
  if (const auto failed = render::failures_of(found->rows); !failed.empty())
    findings.text += "failed (edges per segment): " + failed + "\n";
  return findings;
}

/// Appends a line for each method: "shifted: 40 cells, 4 silently wrong (36 right, 4 other_state)".
void count_silent(const std::vector<record::StabilityRow>& rows, ChartReport& findings) {
  const auto methods = render::distinct(rows, &record::StabilityRow::method);
  for (const auto& method : methods) {
    std::map<std::string, int> count;
    int cells = 0, silent = 0;
    for (const auto& row : rows) {
      if (row.method != method) continue;
      ++cells;
      silent += record::silently_wrong(row.outcome);
      ++count[std::string(word_of(row.outcome))];
    }
    std::string kinds;
    for (const auto& [name, n] : count)
      kinds += fmt::format("{}{} {}", kinds.empty() ? "" : ", ", n, name);
    findings.text +=
        fmt::format("{}: {} cells, {} silently wrong ({})\n", method, cells, silent, kinds);
    findings.summary["silently_wrong"][method] = silent;
  }
}

Result<ChartReport> draw_stability(const preset::Preset& preset, const ChartOptions& options,
                                   const fs::path& folder, Watch& watch) {
  TRY(rows, study::stability_study(preset, limited<study::StabilityOptions>(options), watch));
  TRY_DO(write_file(folder / "stability.csv", record::csv_table(*rows)));
  TRY_DO(render::write_outcome_maps(folder / "stability", *rows,
                                    render::plain(preset.title) + ": where methods work and fail"));
  ChartReport findings;
  count_silent(*rows, findings);
  return findings;
}

Result<void> draw(const preset::Case& run, const ChartOptions& options, const fs::path& folder,
                  Progress& progress, Json& summary, std::string& text) {
  Watch& watch = progress.next_phase();
  TRY_DO(make_folder(folder));
  TRY_DO(write_file(folder / "preset.toml", saved_preset(preset::to_toml(run.preset))));
  TRY(findings, with_name_of(run.preset, options.kind == "accuracy"
                                             ? draw_accuracy(run.preset, options, folder, watch)
                                         : options.kind == "branches"
                                             ? draw_branches(run.preset, folder, watch)
                                             : draw_stability(run.preset, options, folder, watch)));
  summary = {{"preset", run.preset.name}, {"chart", options.kind}};
  summary.update(findings->summary);
  text += (run.name.empty() ? "" : run.name + ":\n") + findings->text;
  return write_file(folder / "summary.json", text_of(summary));
}

Result<int> chart_preset(const ChartOptions& options) {
  TRY(presets, load(options.common));
  if (options.common.print_config) return print_config(*presets);
  const auto runs = runs_of(*presets);
  const auto folder = output_of(options.common, presets->base, "_" + options.kind);
  std::vector<Phase> phases;
  for (const auto& run : runs)
    phases.push_back({run.name.empty() ? "charting" : "charting " + run.name, 100});
  std::string text;
  const auto work = [&](const fs::path& partial, Progress& progress) -> Result<void> {
    Json all{{"preset", presets->base.name}, {"chart", options.kind}, {"cases", Json::array()}};
    for (const auto& run : runs) {
      Json summary = Json::object();
      TRY_DO(draw(run, options, folder_of(partial, run.name), progress, summary, text));
      all["cases"].push_back(std::move(summary));
    }
    if (runs.front().name.empty()) return {};
    return write_file(partial / "summary.json", text_of(all));
  };
  TRY_DO(deliver({folder, "chart " + options.kind}, phases, options.common.quiet, work));
  if (!options.common.quiet) fmt::print("{}: {}\n{}", folder.string(), options.kind, text);
  return ExitCode::done;
}

}  // namespace

void add_chart(CommandLine& program) {
  auto [command, options] = program.add<ChartOptions>(
      "chart", "speed against accuracy; where methods work and fail; branches", chart_preset);
  command.option("KIND", options.kind, "accuracy, stability, or branches (the bifurcation diagram)")
      .required()
      .one_of({"accuracy", "stability", "branches"});
  add_preset_options(command, options.common);
  add_work_options(command, options.common, "folder to write, by default out/<preset>_<KIND>");
  command
      .option("--limit", options.limit_s,
              "seconds after which a run is too slow: by default 30 for accuracy, 4 for "
              "stability")
      .in_range(0.01, 1e6);
  command.option("--edges", options.edges, "edges per segment of the finest mesh of the methods")
      .in_range(4, 32);
  command.option("--sizes", options.sizes,
                 "for accuracy: compares sizes of the shell instead, rods per direction: 12,24,48");
}

}  // namespace gridshell::app
