#include "app/charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "app/branches.h"
#include "app/console.h"
#include "app/delivery.h"
#include "app/loading.h"
#include "engine/core/atomic_file.h"
#include "engine/preset/writer.h"
#include "engine/study/accuracy_study.h"
#include "engine/study/stability_study.h"
#include "render/figure/accuracy_chart.h"
#include "render/figure/outcome_map.h"

namespace gridshell::app {
namespace fs = std::filesystem;
namespace {

using record::Json;

constexpr double wide_mm = 178, high = 105 / wide_mm, low = 80 / wide_mm;  // of a page

Result<Findings> draw_accuracy(const preset::Preset& preset, const ChartOptions& options,
                               const fs::path& folder, Watch& watch) {
  study::AccuracyOptions how;
  if (options.limit_s > 0) how.seconds = options.limit_s;
  how.most_edges = options.edges;
  how.finest = 4 * options.edges;
  if (options.common.threads > 0) how.threads = options.common.threads;
  const auto found = study::accuracy_study(preset, how, watch);
  if (!found) return tl::unexpected(found.error());
  const auto write = [&](const char* name, const std::string& text) {
    return write_atomically(folder / name, text);
  };
  const std::string title = render::plain(preset.title);
  auto written =
      write("accuracy.csv", record::accuracy_csv(found->rows))
          .and_then([&] { return write("scaling.csv", record::scaling_csv(found->scaling)); })
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
  Findings findings;
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
void count_silent(const std::vector<record::StabilityRow>& rows, Findings& findings) {
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

Result<Findings> draw_stability(const preset::Preset& preset, const ChartOptions& options,
                                const fs::path& folder, Watch& watch) {
  study::StabilityOptions how;
  if (options.limit_s > 0) how.seconds = options.limit_s;
  if (options.common.threads > 0) how.threads = options.common.threads;
  const auto rows = study::stability_study(preset, how, watch);
  if (!rows) return tl::unexpected(rows.error());
  const auto written =
      write_atomically(folder / "stability.csv", record::stability_csv(*rows)).and_then([&] {
        return render::write_outcome_maps(
            folder / "stability", *rows,
            render::plain(preset.title) + ": where methods hold and fail");
      });
  if (!written) return tl::unexpected(written.error());
  Findings findings;
  count_silent(*rows, findings);
  return findings;
}

Result<void> draw(const preset::Case& run, const ChartOptions& options, const fs::path& folder,
                  Progress& progress, Json& summary, std::string& text) {
  Watch& watch = progress.next_phase();
  auto made = make_folder(folder).and_then(
      [&] { return write_atomically(folder / "preset.toml", preset::to_toml(run.preset)); });
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
  return write_atomically(folder / "summary.json", record::text_of(summary));
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
        return write_atomically(partial / "summary.json", record::text_of(all));
      });
  if (code == ExitCode::done && !options.common.quiet)
    fmt::print("{}: {}\n{}", folder.string(), options.kind, text);
  return code;
}

}  // namespace gridshell::app
