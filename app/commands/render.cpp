// `gridshell render RUN`: pictures of a finished run, without simulating again.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/case_pictures.h"
#include "app/commands/commands.h"
#include "app/console.h"
#include "app/delivery.h"
#include "app/loading.h"
#include "app/options.h"
#include "app/pictures.h"
#include "engine/core/atomic_file.h"
#include "engine/record/summary_file.h"
#include "engine/record/trajectory_file.h"

namespace gridshell::app {
namespace fs = std::filesystem;
namespace {

// one run folder, read back
struct FinishedRun {
  std::string name;  // of the case, empty without cases
  preset::Preset preset;
  record::Trajectory trajectory;
  record::Summary summary;
  Pictures pictures = Pictures::movie;
};

// the folders of the cases, or the run itself as one case without a name
Result<std::vector<std::string>> case_names(const fs::path& run) {
  const auto text = as_input(read_whole(run / "summary.json"));
  if (!text)
    return fail(Fault::bad_input,
                fmt::format("'{}' is no run: {}", run.string(), text.error().message));
  const auto json = nlohmann::json::parse(*text, nullptr, false);
  if (!json.is_object() || !json.contains("cases")) return std::vector<std::string>{""};
  std::vector<std::string> names;
  for (const auto& one : json["cases"])
    if (one.is_object() && one.contains("name") && one["name"].is_string())
      names.push_back(one["name"]);
  if (names.empty())
    return fail(Fault::bad_input,
                fmt::format("'{}' is no run: its summary.json lists no cases", run.string()));
  return names;
}

// only how it is shown may change once a run is finished
Result<std::vector<preset::Override>> picture_overrides(const Options& options) {
  auto overrides = overrides_of(options);
  if (!overrides) return overrides;
  for (const auto& change : *overrides) {
    const bool shows = change.key.starts_with("movie.") || change.key.starts_with("figure.") ||
                       change.key.starts_with("style.");
    if (!shows || change.key == "movie.frames" || change.key == "figure.radii_mm")
      return fail(Fault::bad_input,
                  fmt::format("{}: {} cannot change once a run is finished; 'render' takes keys of "
                              "[movie], [style] and [figure] that only show it",
                              change.source, change.key));
  }
  return overrides;
}

// a run sampled at the stills' radii, or of a net's end alone, came from `figure`
Pictures pictures_of(const preset::Preset& preset, const record::Trajectory& trajectory,
                     const fs::path& folder) {
  // a push is sampled alike for both
  const auto still = fs::path(preset.name).filename().string() + ".png";
  if (preset.indentation.wanted())
    return fs::exists(folder / still) ? Pictures::stills : Pictures::movie;
  const bool circle = preset.footprint.kind == preset::FootprintKind::circle;
  if (!circle) return trajectory.frames.size() == 1 ? Pictures::stills : Pictures::movie;
  const auto& radii = preset.figure.radii_mm;
  if (radii.size() != trajectory.frames.size()) return Pictures::movie;
  for (std::size_t k = 0; k < radii.size(); ++k)
    if (!(std::abs(radii[k] - trajectory.frames[k].boundary_radius_mm) < 1e-6 * radii[k]))
      return Pictures::movie;
  return Pictures::stills;
}

Result<FinishedRun> read_run(const fs::path& folder, const std::string& name,
                             const std::vector<preset::Override>& overrides) {
  FinishedRun run{name, {}, {}, {}, Pictures::movie};
  auto presets = preset::read_preset_file(folder / "preset.toml", overrides);
  if (!presets) return tl::unexpected(presets.error());
  auto summary = as_input(record::read_summary(folder / "summary.json"));
  if (!summary) return tl::unexpected(summary.error());
  auto trajectory = as_input(record::read_trajectory(folder / "trajectory.h5"));
  if (!trajectory) return tl::unexpected(trajectory.error());
  run.preset = std::move(presets->base);
  run.preset.name = summary->preset;
  run.summary = std::move(*summary);
  run.trajectory = std::move(*trajectory);
  run.pictures = pictures_of(run.preset, run.trajectory, folder);
  run.preset.movie.frames = int(run.trajectory.frames.size());
  return run;
}

bool is_still(const FinishedRun& run) { return run.pictures == Pictures::stills; }
bool shows_net(const FinishedRun& run) { return is_still(run) && shown_on_net(run.preset); }
bool shows_push(const FinishedRun& run) { return is_still(run) && run.preset.indentation.wanted(); }
bool drawn_beside(const FinishedRun& run) {
  return run.pictures == Pictures::movie && beside_one_another(run.preset, run.name);
}

bool is_picture(const fs::path& path) {
  const auto kind = path.extension();
  return path.filename() == "frames" || kind == ".png" || kind == ".svg" || kind == ".pdf" ||
         kind == ".mp4" || kind == ".webm" || kind == ".gif";
}

// everything of a run but its pictures; hidden files are someone's half-written ones
Result<void> copy_data(const fs::path& from, const fs::path& to) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(from, error)) {
    const auto name = entry.path().filename();
    if (entry.is_directory() || is_picture(name) || name.string().starts_with('.')) continue;
    fs::copy_file(entry.path(), to / name, fs::copy_options::overwrite_existing, error);
    if (error) break;
  }
  if (error)
    return fail(Fault::io, fmt::format("cannot copy '{}' to '{}': {}", from.string(), to.string(),
                                       error.message()));
  return {};
}

// what shows several runs, as it was made
Result<void> draw_together(std::vector<FinishedRun>& runs, const fs::path& from, Artist& artist,
                           const fs::path& to, Progress& progress) {
  std::vector<CaseRecord> records;
  for (auto& run : runs)
    if (is_still(run) || drawn_beside(run)) records.push_back({run.preset, run.trajectory});
  if (records.empty()) return {};
  const auto name = fs::path(runs.front().summary.preset);
  auto stem = runs.front().name.empty() ? name.filename() : name.parent_path().filename();
  if (stem.empty()) stem = from.filename();
  if (drawn_beside(runs.front()))
    return draw_beside(records, stem.string(), artist.renderer(), to, progress.next_phase());
  return draw_case_figures(std::move(records), artist.renderer(), to / stem,
                           [&]() -> Watch& { return progress.next_phase(); });
}

Result<void> draw_run(FinishedRun& run, const SharedBar& bar, Artist& artist, const fs::path& from,
                      const fs::path& to, Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  return make_folder(to)
      .and_then([&] {
        if (drawn_beside(run)) return Result<void>{};
        const bool curve = shows_push(run);
        return artist.draw(run.pictures, run.preset,
                           curve ? ends_of(run.trajectory) : run.trajectory, bar, to,
                           progress.next_phase());
      })
      .and_then([&] { return copy_data(from, to); })
      .and_then([&] {
        run.summary.seconds_render =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        return record::write_summary(to / "summary.json", run.summary);
      });
}

Result<std::vector<FinishedRun>> read_runs(const Options& options) {
  const auto overrides = picture_overrides(options);
  if (!overrides) return tl::unexpected(overrides.error());
  const auto names = case_names(options.input);
  if (!names) return tl::unexpected(names.error());
  std::vector<FinishedRun> runs;
  for (const auto& name : *names) {
    auto run = read_run(folder_of(options.input, name), name, *overrides);
    if (!run) return tl::unexpected(run.error());
    runs.push_back(std::move(*run));
  }
  return runs;
}

void print_drawn(const FinishedRun& run, const fs::path& folder) {
  fmt::print("{}: {:.1f} s drawn\n", folder.string(), run.summary.seconds_render);
  fmt::print("{}", how_to_make_movie(folder, run.preset));
}

int render(const Options& options) {
  auto runs = read_runs(options);
  if (!runs) return report(runs.error());
  const fs::path from = options.input;
  const auto folder = options.output.empty() ? from : options.output;
  std::vector<Phase> phases;
  for (const auto& run : *runs)
    if (!drawn_beside(run))
      phases.push_back({"drawing" + (run.name.empty() ? "" : " " + run.name),
                        expected_seconds(run.pictures, run.preset)});
  const bool page = runs->front().preset.page.kind != preset::PageKind::none;
  if (page && is_still(runs->front()))
    phases.push_back(
        {"drawing the page",
         double(runs->size()) * expected_seconds(Pictures::stills, runs->front().preset)});
  if (!page && std::any_of(runs->begin(), runs->end(), shows_net))
    phases.push_back({"drawing shells over nets",
                      2 * double(runs->size()) *
                          expected_seconds(runs->front().pictures, runs->front().preset)});
  if (drawn_beside(runs->front()))
    phases.push_back({"drawing", expected_seconds(Pictures::movie, runs->front().preset)});
  if (!page && std::any_of(runs->begin(), runs->end(), shows_push))
    phases.push_back(
        {"drawing point loads",
         double(runs->size()) * expected_seconds(Pictures::stills, runs->front().preset)});
  const auto work = [&](const fs::path& partial, Progress& progress) -> Result<void> {
    auto artist = Artist::create(options.context, options.threads);
    if (!artist) return tl::unexpected(artist.error());
    std::vector<CaseRecord> all;
    for (const auto& run : *runs) all.push_back({run.preset, run.trajectory});
    const auto bars = shared_bars(all, runs->front().pictures);
    all.clear();
    for (std::size_t k = 0; k < runs->size(); ++k) {
      auto& run = (*runs)[k];
      auto drawn = draw_run(run, bars[k], *artist, folder_of(from, run.name),
                            folder_of(partial, run.name), progress);
      if (!drawn) return drawn;
    }
    if (auto drawn = draw_together(*runs, from, *artist, partial, progress); !drawn) return drawn;
    return runs->front().name.empty() ? Result<void>{} : copy_data(from, partial);
  };
  const int code = deliver(folder, phases, options.quiet, work);
  if (code == ExitCode::done && !options.quiet)
    for (const auto& run : *runs) print_drawn(run, folder_of(folder, run.name));
  return code;
}

}  // namespace

void add_render(CLI::App& program, Action& action) {
  const auto options = std::make_shared<Options>();
  auto* command =
      program.add_subcommand("render", "pictures of a finished run, without simulating again");
  add_run_options(*command, *options);
  add_work_options(*command, *options, "folder to write, by default RUN itself");
  add_picture_options(*command, *options);
  command->callback([&action, options] { action = [options] { return render(*options); }; });
}

}  // namespace gridshell::app
