// How reliable the reports of a run are, by random scenes that are solved twice (trust_study.h):
//   bench_trust --scenes 600 --seed 707 -o out/trust
// writes trust.csv (a row per scene), summary.json and each scene that was silently wrong as a
// preset, prints the number of scenes of each outcome, and exits with 3 if any was silently wrong.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "engine/core/file_io.h"
#include "engine/core/try.h"
#include "engine/formats/csv.h"
#include "engine/preset/preset_file.h"
#include "tests/bench/trust_study.h"

using namespace gridshell;
namespace fs = std::filesystem;

namespace {

nlohmann::ordered_json summary_of(const std::vector<bench::TrustScene>& scenes, int seed) {
  std::map<std::string, int> classes;
  int silent = 0, snap_alone = 0, doubts = 0;
  for (const auto& scene : scenes) {
    ++classes[std::string(word_of(scene.row.found))];
    silent += bench::silently_wrong(scene.row.found);
    snap_alone += scene.row.snap_alone();
    doubts += scene.row.doubt;
  }
  return {{"scenes", scenes.size()},  {"seed", seed},
          {"classes", classes},       {"silently_wrong", silent},
          {"snap_alone", snap_alone}, {"doubts", doubts}};
}

Result<int> judge(const bench::TrustOptions& options, const fs::path& folder) {
  Watch watch;
  TRY(scenes, bench::trust_study(options, watch));
  TRY_DO(make_folder(folder));
  std::vector<bench::TrustRow> rows;
  for (const auto& scene : *scenes) {
    rows.push_back(scene.row);
    if (bench::silently_wrong(scene.row.found))
      TRY_DO(write_file(folder / (scene.preset.name + ".toml"), preset::to_toml(scene.preset)));
  }
  const auto summary = summary_of(*scenes, options.seed);
  TRY_DO(write_file(folder / "trust.csv", record::csv_table(rows)));
  TRY_DO(write_file(folder / "summary.json", summary.dump(1) + "\n"));
  const int silent = summary["silently_wrong"];
  fmt::print("{}: {} scenes, {} silently wrong\n", folder.string(), rows.size(), silent);
  for (const auto& [name, count] : summary["classes"].items())
    fmt::print("  {:22} {}\n", name, count.get<int>());
  fmt::print("a snap that one family of meshes alone reports: {}\n",
             summary["snap_alone"].get<int>());
  fmt::print("runs that report meshes which do not agree: {}\n", summary["doubts"].get<int>());
  return silent == 0 ? 0 : 3;
}

}  // namespace

int main(int count, char** words) {
  CLI::App program("Random scenes, solved as by default and on other meshes");
  bench::TrustOptions options;
  std::string folder = "out/trust", kind;
  program.add_option("--scenes", options.scenes, "how many, of ten kinds in turn")
      ->check(CLI::Range(1, 100000));
  program.add_option("--scene-kind", kind, "of this kind alone; networks are made only by it")
      ->check(CLI::IsMember(all_words<bench::SceneKind>()));
  program.add_option("--seed", options.seed, "other scenes")->check(CLI::Range(0, 1 << 30));
  program.add_option("--limit", options.seconds, "seconds after which a run is too slow");
  program.add_option("--threads", options.threads, "at a time")->check(CLI::Range(1, 256));
  program.add_option("-o", folder, "folder to write");
  CLI11_PARSE(program, count, words);
  options.kind = find_word<bench::SceneKind>(kind);
  const auto done = judge(options, folder);
  if (!done) fmt::print(stderr, "error: {}\n", done.error().message);
  return done ? *done : 1;
}
