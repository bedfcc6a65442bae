#include "app/trust.h"

#include <fmt/format.h>

#include <map>

#include "app/console.h"
#include "app/delivery.h"
#include "engine/core/atomic_file.h"
#include "engine/preset/writer.h"
#include "engine/record/json.h"
#include "engine/study/trust_study.h"
#include "render/figure/trust_chart.h"

namespace gridshell::app {
namespace fs = std::filesystem;
namespace {

using record::Json;

Result<void> write_worst(const std::vector<study::TrustScene>& scenes, const fs::path& folder) {
  for (const auto& scene : scenes) {
    if (!record::silently_wrong(scene.row.found)) continue;
    if (auto made = make_folder(folder); !made) return made;
    const auto file = folder / (scene.preset.name + ".toml");
    if (auto written = write_atomically(file, preset::to_toml(scene.preset)); !written)
      return written;
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
  const int code =
      deliver(folder, {{"judging scenes", 100}}, options.common.quiet,
              [&](const fs::path& partial, Progress& progress) -> Result<void> {
                const auto scenes = study::trust_study(how, progress.next_phase());
                if (!scenes) return tl::unexpected(scenes.error());
                std::vector<record::TrustRow> rows;
                for (const auto& scene : *scenes) rows.push_back(scene.row);
                summary = summary_of(rows, how.seed);
                return write_atomically(partial / "trust.csv", record::trust_csv(rows))
                    .and_then([&] { return render::write_trust_bars(partial / "trust", rows); })
                    .and_then([&] {
                      return render::write_plot(partial / "errors", render::trust_plot(rows));
                    })
                    .and_then([&] { return write_worst(*scenes, partial / "worst"); })
                    .and_then([&] {
                      return write_atomically(partial / "summary.json", record::text_of(summary));
                    });
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
