#include "app/cli/chart.h"

#include <fmt/format.h>
#include <algorithm>
#include <map>

#include "app/cli/console.h"
#include "app/cli/delivery.h"
#include "app/cli/preset_library.h"
#include "engine/core/file_io.h"
#include "engine/core/json.h"
#include "engine/core/try.h"
#include "engine/gridshell.h"
#include "render/movie/state_charts.h"
#include "render/movie/validation_charts.h"

namespace gridshell::app {
namespace {

using record::BranchEvent;
using record::BranchPoint;

std::string place_of(const BranchPoint& point, double original_radius_mm) {
  if (!std::isfinite(point.boundary_radius_mm))
    return fmt::format("progress {:.4f}", point.progress);
  return fmt::format("R_a = {:.4f} R_o", point.boundary_radius_mm / original_radius_mm);
}

/// "branch 1: 88 points, 80 of them stable; bifurcation at ...", a line a branch.
void tell(const study::BranchDiagram& diagram, ChartReport& findings) {
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
                              place_of(point, diagram.original_radius_mm));
    }
    findings.text += fmt::format("{}: {} points, {} of them stable{}\n",
                                 branch == 0 ? "the path" : fmt::format("branch {}", branch), count,
                                 stable, events);
  }
}

}  // namespace

Result<ChartReport> draw_branches(const preset::Preset& preset, const std::filesystem::path& folder,
                                  Watch& watch) {
  TRY(found, study::branches_study(preset, {}, watch));
  auto written =
      write_file(folder / "branches.csv", record::csv_table(found->points)).and_then([&] {
        return render::write_branches(folder / "branches", found->points, preset.title);
      });
  if (!written) return tl::unexpected(written.error());
  ChartReport findings;
  findings.summary["edges_per_segment"] = found->edges_per_segment;
  findings.summary["branches"] = found->points.empty() ? 0 : found->points.back().branch + 1;
  findings.summary["symmetry_order"] = found->symmetry_order;
  findings.summary["all_followed"] = found->all_followed;
  findings.text = fmt::format(
      "on {} edges a segment; the amplitude is of what breaks {} of the "
      "symmetries of the square\n",
      found->edges_per_segment, found->symmetry_order);
  tell(*found, findings);
  if (!found->all_followed) findings.text += "there are more branches than were followed\n";
  return findings;
}

namespace fs = std::filesystem;
namespace {

constexpr double wide_mm = 178, high = 105 / wide_mm, low = 80 / wide_mm;  // of a page

Result<ChartReport> draw_accuracy(const preset::Preset& preset, const ChartOptions& options,
                                  const fs::path& folder, Watch& watch) {
  study::AccuracyOptions how;
  if (options.limit_s > 0) how.seconds = options.limit_s;
  how.most_edges = options.edges;
  how.finest = 4 * options.edges;
  if (options.common.threads > 0) how.threads = options.common.threads;
  TRY(found, study::accuracy_study(preset, how, watch));
  const auto write = [&](const char* name, const std::string& text) {
    return write_file(folder / name, text);
  };
  const std::string title = render::plain(preset.title);
  auto written =
      write("accuracy.csv", record::csv_table(found->rows))
          .and_then([&] { return write("scaling.csv", record::csv_table(found->scaling)); })
          .and_then([&] {
            return render::write_plot(
                folder / "accuracy",
                render::accuracy_plot(found->rows, title + ": error over time"), {wide_mm}, high);
          })
          .and_then([&] {
            return render::write_plot(
                folder / "unknowns",
                render::unknowns_plot(found->rows, title + ": error over unknowns"), {wide_mm},
                high);
          })
          .and_then([&] {
            return render::write_plot(
                folder / "scaling",
                render::scaling_plot(found->scaling, title + ": time over size"), {wide_mm}, low);
          });
  if (!written) return tl::unexpected(written.error());
  ChartReport findings;
  findings.summary["reference_error"] = found->reference_error;
  for (const auto& at : found->standings) {
    findings.text += fmt::format(
        "auto at {:.0e}: error {:.1e} in {:.3f} s, {:.2f} of the fastest as accurate, {:.2f} of "
        "the fastest within the tolerance\n",
        at.tolerance, at.error, at.cpu_s, at.cpu_s / at.front_s, at.cpu_s / at.asked_s);
    findings.summary["auto"].push_back({{"tolerance", at.tolerance},
                                        {"error", at.error},
                                        {"cpu_s", at.cpu_s},
                                        {"over_front", at.cpu_s / at.front_s},
                                        {"over_asked", at.cpu_s / at.asked_s}});
  }
  int silent = 0;
  for (const auto& row : found->rows) silent += record::silently_wrong(row.outcome);
  findings.summary["silently_wrong"] = silent;
  if (const auto failed = render::failures_of(found->rows); !failed.empty())
    findings.text += "failed (edges a segment): " + failed + "\n";
  return findings;
}

/// "shifted: 40 cells, 36 right, 4 silently wrong (4 other_state)", a line a method.
void count_silent(const std::vector<record::StabilityRow>& rows, ChartReport& findings) {
  std::vector<std::string> methods;
  for (const auto& row : rows)
    if (std::find(methods.begin(), methods.end(), row.method) == methods.end())
      methods.push_back(row.method);
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
  study::StabilityOptions how;
  if (options.limit_s > 0) how.seconds = options.limit_s;
  if (options.common.threads > 0) how.threads = options.common.threads;
  TRY(rows, study::stability_study(preset, how, watch));
  const auto written = write_file(folder / "stability.csv", record::csv_table(*rows)).and_then([&] {
    return render::write_outcome_maps(
        folder / "stability", *rows, render::plain(preset.title) + ": where methods hold and fail");
  });
  if (!written) return tl::unexpected(written.error());
  ChartReport findings;
  count_silent(*rows, findings);
  return findings;
}

Result<void> draw(const preset::Case& run, const ChartOptions& options, const fs::path& folder,
                  Progress& progress, Json& summary, std::string& text) {
  Watch& watch = progress.next_phase();
  auto made = make_folder(folder).and_then(
      [&] { return write_file(folder / "preset.toml", preset::to_toml(run.preset)); });
  if (!made) return made;
  auto findings = options.kind == "accuracy"   ? draw_accuracy(run.preset, options, folder, watch)
                  : options.kind == "branches" ? draw_branches(run.preset, folder, watch)
                                               : draw_stability(run.preset, options, folder, watch);
  if (!findings) {
    findings.error().message = run.preset.name + ": " + findings.error().message;
    return tl::unexpected(findings.error());
  }
  summary = {{"preset", run.preset.name}, {"chart", options.kind}};
  summary.update(findings->summary);
  text += (run.name.empty() ? "" : run.name + ":\n") + findings->text;
  return write_file(folder / "summary.json", text_of(summary));
}

}  // namespace

int chart(const ChartOptions& options) {
  const auto presets = load(options.common);
  if (!presets) return report(presets.error());
  if (options.common.print_config) {
    fmt::print("{}", preset::to_toml(*presets));
    return ExitCode::done;
  }
  const auto runs = runs_of(*presets);
  const auto name = presets->base.name + "_" + options.kind;
  const auto folder =
      options.common.output.empty() ? fs::path("out") / name : options.common.output;
  std::vector<Phase> phases;
  for (const auto& run : runs)
    phases.push_back({run.name.empty() ? "charting" : "charting " + run.name, 100});
  std::string text;
  const int code = deliver(
      folder, phases, options.common.quiet,
      [&](const fs::path& partial, Progress& progress) -> Result<void> {
        Json all{{"preset", presets->base.name}, {"chart", options.kind}, {"cases", Json::array()}};
        for (const auto& run : runs) {
          Json summary = Json::object();
          auto drawn = draw(run, options, folder_of(partial, run.name), progress, summary, text);
          if (!drawn) return drawn;
          all["cases"].push_back(std::move(summary));
        }
        if (runs.front().name.empty()) return {};
        return write_file(partial / "summary.json", text_of(all));
      });
  if (code == ExitCode::done && !options.common.quiet)
    fmt::print("{}: {}\n{}", folder.string(), options.kind, text);
  return code;
}

namespace fs = std::filesystem;
namespace {

Result<void> write_worst(const std::vector<study::TrustScene>& scenes, const fs::path& folder) {
  for (const auto& scene : scenes) {
    if (!record::silently_wrong(scene.row.found)) continue;
    if (auto made = make_folder(folder); !made) return made;
    const auto file = folder / (scene.preset.name + ".toml");
    if (auto written = write_file(file, preset::to_toml(scene.preset)); !written) return written;
  }
  return {};
}

Json summary_of(const std::vector<record::TrustRow>& rows, int seed) {
  std::map<std::string, int> classes;
  int silent = 0, snap_alone = 0, doubts = 0;
  for (const auto& row : rows) {
    ++classes[std::string(word_of(row.found))];
    silent += record::silently_wrong(row.found);
    snap_alone += row.snap_alone();
    doubts += row.doubt;
  }
  Json summary = Json::object();
  summary["chart"] = "trust";
  summary["scenes"] = rows.size();
  summary["seed"] = seed;
  summary["classes"] = classes;
  summary["silently_wrong"] = silent;
  summary["snap_alone"] = snap_alone;
  summary["doubts"] = doubts;
  return summary;
}

}  // namespace

int chart_trust(const ChartOptions& options) {
  const fs::path folder =
      options.common.output.empty() ? fs::path("out") / "trust" : options.common.output;
  study::TrustOptions how;
  how.scenes = options.scenes;
  how.seed = options.seed;
  if (options.limit_s > 0) how.seconds = options.limit_s;
  if (options.common.threads > 0) how.threads = options.common.threads;
  Json summary;
  const int code = deliver(
      folder, {{"judging scenes", 100}}, options.common.quiet,
      [&](const fs::path& partial, Progress& progress) -> Result<void> {
        TRY(scenes, study::trust_study(how, progress.next_phase()));
        std::vector<record::TrustRow> rows;
        for (const auto& scene : *scenes) rows.push_back(scene.row);
        summary = summary_of(rows, how.seed);
        return write_file(partial / "trust.csv", record::csv_table(rows))
            .and_then([&] { return render::write_trust_bars(partial / "trust", rows); })
            .and_then(
                [&] { return render::write_plot(partial / "errors", render::trust_plot(rows)); })
            .and_then([&] { return write_worst(*scenes, partial / "worst"); })
            .and_then([&] { return write_file(partial / "summary.json", text_of(summary)); });
      });
  if (code != ExitCode::done) return code;
  const int silent = summary["silently_wrong"].get<int>();
  if (!options.common.quiet) {
    fmt::print("{}: {} scenes, {} silently wrong\n", folder.string(), how.scenes, silent);
    for (const auto& [name, count] : summary["classes"].items())
      fmt::print("  {:22} {}\n", name, count.get<int>());
    fmt::print("a snap that one family of meshes alone tells of: {}\n",
               summary["snap_alone"].get<int>());
    fmt::print("runs that told of leading meshes which do not agree: {}\n",
               summary["doubts"].get<int>());
  }
  return silent == 0 ? ExitCode::done : ExitCode::different;
}

}  // namespace gridshell::app
