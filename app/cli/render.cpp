// `gridshell render RUN`: pictures of a finished run, without simulating again.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>

#include "app/cli/commands.h"
#include "app/cli/console.h"
#include "app/cli/delivery.h"
#include "app/cli/figures.h"
#include "app/cli/finished_run.h"
#include "app/cli/options.h"
#include "app/cli/pictures.h"
#include "app/cli/preset_library.h"
#include "app/cli/staged_folder.h"
#include "engine/core/file_io.h"
#include "engine/core/try.h"
#include "engine/gridshell.h"

namespace gridshell::app {
namespace fs = std::filesystem;
namespace {

bool is_still(const FinishedRun& run) { return run.pictures == Pictures::stills; }
bool shows_net(const FinishedRun& run) { return is_still(run) && shown_on_net(run.preset); }
bool shows_push(const FinishedRun& run) { return is_still(run) && run.preset.indentation.wanted(); }
bool drawn_beside(const FinishedRun& run) {
  return run.pictures == Pictures::movie && drawn_side_by_side(run.preset, run.name);
}

bool is_picture(const fs::path& path) {
  const auto kind = path.extension();
  return path.filename() == "frames" || kind == ".png" || kind == ".svg" || kind == ".pdf" ||
         kind == ".mp4" || kind == ".webm" || kind == ".gif";
}

// everything of a run but its pictures; hidden files are someone's half-written ones
Result<void> copy_data(const fs::path& from, const fs::path& to) {
  std::error_code error;
  for (fs::directory_iterator at(from, error), end; !error && at != end; at.increment(error)) {
    const auto& entry = *at;
    const auto name = entry.path().filename();
    if (!entry.is_regular_file(error) || entry.is_symlink(error) || is_picture(name) ||
        name.string().starts_with('.') || name == manifest_name)
      continue;
    fs::copy_file(entry.path(), to / name, fs::copy_options::overwrite_existing, error);
    if (error) break;
  }
  if (error)
    return fail(Fault::io, fmt::format("cannot copy '{}' to '{}': {}", from.string(), to.string(),
                                       error.message()));
  return {};
}

// what all cases together are called: by the preset that lists them, else by their folder
std::string title_of_cases(const fs::path& from, const std::string& otherwise) {
  const auto listing = preset::read_preset_file(from / "preset.toml", {});
  return listing && !listing->base.title.empty() ? listing->base.title : otherwise;
}

// what shows several runs, as it was made
Result<void> draw_together(std::vector<FinishedRun>& runs, const fs::path& from,
                           PictureMaker& artist, const fs::path& to, Progress& progress) {
  std::vector<CaseRun> records;
  for (auto& run : runs)
    if (is_still(run) || drawn_beside(run))
      records.push_back({run.preset, run.trajectory, run.states});
  if (records.empty()) return {};
  const auto name = fs::path(runs.front().summary.preset);
  auto stem = runs.front().name.empty() ? name.filename() : name.parent_path().filename();
  if (stem.empty()) stem = from.filename();
  if (drawn_beside(runs.front()))
    return draw_beside(records, title_of_cases(from, stem.string()), artist.renderer(), to,
                       progress.next_phase());
  return draw_case_figures(std::move(records), title_of_cases(from, stem.string()),
                           artist.renderer(), to / stem,
                           [&]() -> Watch& { return progress.next_phase(); });
}

Result<void> draw_run(FinishedRun& run, const SharedColourBar& bar, PictureMaker& artist,
                      const fs::path& from, const fs::path& to, Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  return make_folder(to)
      .and_then([&] {
        if (drawn_beside(run)) return Result<void>{};
        if (run.preset.jitter.wanted())
          return draw_states({run.preset, run.trajectory, run.states}, artist.renderer(),
                             to / fs::path(run.preset.name).filename(), progress.next_phase());
        const bool ends = is_still(run) && stills_show_ends(run.preset);
        const record::Trajectory& all = run.trajectory;
        return artist.draw(run.pictures, run.preset, ends ? ends_of(all) : all, bar, to,
                           progress.next_phase());
      })
      .and_then([&] {
        if (!run.in_journal) return copy_data(from, to);
        return read_file(from / "preset.toml")
            .and_then([&](const std::string& text) { return write_file(to / "preset.toml", text); })
            .and_then([&] { return record::write_run(to, run.trajectory, run.summary); });
      })
      .and_then([&] {
        run.summary.kind =
            run.pictures == Pictures::stills ? record::Kind::figure : record::Kind::movie;
        run.summary.seconds_render =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        return record::write_summary(to / "summary.json", run.summary);
      });
}

void print_drawn(const FinishedRun& run, const fs::path& folder) {
  fmt::print("{}: {:.1f} s drawn\n", folder.string(), run.summary.seconds_render);
  fmt::print("{}", how_to_make_movie(folder, run.preset));
}

int render(const Options& options, bool unsealed) {
  const auto overrides = overrides_of_run(options);
  if (!overrides) return report(overrides.error());
  auto runs = read_runs(options.input, *overrides, unsealed);
  if (!runs) return report(runs.error());
  for (const auto& run : *runs)
    if (!run.summary.finished)
      std::fprintf(stderr, "'%s' is not finished: %s\n", folder_of(options.input, run.name).c_str(),
                   progress_text(run).c_str());
  const fs::path from = options.input;
  const auto folder = options.output.empty() ? from : options.output;
  std::vector<Phase> phases;
  for (const auto& run : *runs)
    if (!drawn_beside(run))
      phases.push_back(drawing("drawing" + (run.name.empty() ? "" : " " + run.name),
                               expected_seconds(run.pictures, run.preset)));
  const bool page = runs->front().preset.page.kind != preset::PageKind::none;
  if (page && is_still(runs->front()))
    phases.push_back(
        drawing("drawing the page",
                double(runs->size()) * expected_seconds(Pictures::stills, runs->front().preset)));
  if (!page && std::any_of(runs->begin(), runs->end(), shows_net))
    phases.push_back(drawing(
        "drawing shells over nets",
        2 * double(runs->size()) * expected_seconds(runs->front().pictures, runs->front().preset)));
  if (drawn_beside(runs->front()))
    phases.push_back(drawing("drawing", expected_seconds(Pictures::movie, runs->front().preset)));
  if (!page && std::any_of(runs->begin(), runs->end(), shows_push))
    phases.push_back(
        drawing("drawing point loads",
                double(runs->size()) * expected_seconds(Pictures::stills, runs->front().preset)));
  const auto work = [&](const fs::path& partial, Progress& progress) -> Result<void> {
    TRY(artist, PictureMaker::create(options.context, runs->front().preset.style.font));
    std::vector<CaseRun> all;
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
  const auto unsealed = std::make_shared<bool>(false);
  auto* command =
      program.add_subcommand("render", "pictures of a finished run, without simulating again");
  add_run_options(*command, *options);
  add_work_options(*command, *options, "folder to write, by default RUN itself");
  add_picture_options(*command, *options);
  command->add_flag("--unsealed", *unsealed,
                    "take a trajectory.h5 that another program wrote or changed");
  command->callback([&action, options, unsealed] {
    action = [options, unsealed] { return render(*options, *unsealed); };
  });
}

}  // namespace gridshell::app
