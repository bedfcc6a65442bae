#include "app/cli/produce.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "app/cli/console.h"
#include "app/cli/delivery.h"
#include "app/cli/figures.h"
#include "app/cli/preset_library.h"
#include "engine/core/file_io.h"
#include "engine/core/json.h"
#include "engine/core/parallel.h"
#include "engine/core/try.h"
#include "engine/gridshell.h"

namespace gridshell::app {
namespace fs = std::filesystem;
namespace {

// one run of the preset, and where it goes
struct Job {
  std::string name;  // of the case, empty without cases
  preset::Preset preset;
  experiment::Plan plan;
  record::Summary summary;     // once it has run
  record::StateTables states;  // that a search found
  double length_scale_mm = 0;
};

// `figure` without radii shows the final state
preset::Preset with_stills(preset::Preset preset, Pictures pictures) {
  const bool circle = preset.footprint.kind == preset::FootprintKind::circle;
  if (pictures == Pictures::stills && circle && preset.figure.radii_mm.empty())
    preset.figure.radii_mm = {preset.actuated_radius_mm()};
  return preset;
}

Result<std::vector<Job>> jobs_of(const preset::Presets& presets, Pictures pictures) {
  std::vector<Job> jobs;
  for (const auto& run : runs_of(presets)) {
    if (run.preset.jitter.wanted() && pictures == Pictures::movie)
      return fail(
          Fault::bad_input,
          fmt::format("{}: a search for states ([jitter] trials or confined above 0) has no "
                      "movie; 'gridshell figure' draws the states, [jitter] trials = 0 "
                      "and confined = 0 make the actuation's movie",
                      run.preset.name));
    TRY(plan, plan_of(run.preset));
    jobs.push_back({run.name, with_stills(run.preset, pictures), *plan, {}, {}, 0});
  }
  return jobs;
}

// the first equilibrium and some milliseconds a frame, where the engine does not say
double simulation_guess(const Job& job) { return 0.5 + 0.01 * job.preset.movie.frames; }

bool has_net(const Job& job) { return shown_on_net(job.preset); }
bool is_push(const preset::Preset& preset) { return preset.indentation.wanted(); }
bool is_pushed(const Job& job) { return is_push(job.preset); }
bool is_search(const preset::Preset& preset) { return preset.jitter.wanted(); }

// what is drawn once all cases have run
bool drawn_beside(const Job& job, Pictures pictures) {
  return pictures == Pictures::movie && drawn_side_by_side(job.preset, job.name);
}

std::vector<Phase> phases_of(const std::vector<Job>& jobs, Pictures pictures) {
  std::vector<Phase> phases;
  for (const auto& job : jobs) {
    const double guess = job.plan.expected_seconds;
    const auto of_case = job.name.empty() ? "" : " " + job.name;
    phases.push_back({"simulating" + of_case, std::isnan(guess) ? simulation_guess(job) : guess});
  }
  for (const auto& job : jobs)
    if (pictures != Pictures::none && !drawn_beside(job, pictures))
      phases.push_back(drawing("drawing" + (job.name.empty() ? "" : " " + job.name),
                               expected_seconds(pictures, job.preset)));
  if (drawn_beside(jobs.front(), pictures))
    phases.push_back(drawing("drawing", expected_seconds(pictures, jobs.front().preset)));
  const bool stills = pictures == Pictures::stills;
  if (stills && jobs.front().preset.page.kind != preset::PageKind::none) {
    phases.push_back(drawing(
        "drawing the page", double(jobs.size()) * expected_seconds(pictures, jobs.front().preset)));
    return phases;
  }
  if (stills && std::any_of(jobs.begin(), jobs.end(), has_net))
    phases.push_back(
        drawing("drawing shells over nets",
                double(jobs.size()) * expected_seconds(pictures, jobs.front().preset)));
  if (stills && std::any_of(jobs.begin(), jobs.end(), is_pushed))
    phases.push_back(
        drawing("drawing point loads",
                double(jobs.size()) * expected_seconds(pictures, jobs.front().preset)));
  return phases;
}

record::Kind kind_of(Pictures pictures) {
  switch (pictures) {
    case Pictures::none:
      return record::Kind::run;
    case Pictures::movie:
      return record::Kind::movie;
    case Pictures::stills:
      return record::Kind::figure;
  }
  return record::Kind::unknown;
}

// what may bring a run further that ended before its end; empty where nothing is known
std::string help_for(const preset::Preset& preset, record::Limit limit) {
  switch (limit) {
    case record::Limit::none:
    case record::Limit::snap:
      return "";
    case record::Limit::locking:
      return is_push(preset) ? "less depth, or more [limits] max_strain, would end before that"
                             : "a larger actuated boundary, or more [limits] max_strain, would end "
                               "before that";
    case record::Limit::branch_lost:
    case record::Limit::no_equilibrium:
      break;
  }
  if (preset.actuation.start == preset::Start::net)
    return "what may help: --set actuation.start=flat, the patient way from the flat footprint";
  return "what may help: --set accuracy.edges_per_segment=8";
}

// one run, a path's or a search for states
Result<record::Summary> run_job(Job& job, Pictures pictures, int threads, record::Sink& sink,
                                Watch& watch) {
  if (!is_search(job.preset))
    return experiment::run(job.preset, pictures == Pictures::stills, sink, watch);
  return experiment::run_states(job.preset, threads, sink, watch)
      .map([&](experiment::StateSearchRun run) {
        job.states = std::move(run.tables);
        return run.summary;
      });
}

// every frame is on the disk as soon as it is found, and all runs before a picture of one is drawn
Result<void> simulate(Job& job, Pictures pictures, int threads, const fs::path& folder,
                      Progress& progress, std::vector<CaseRun>& records) {
  auto made = make_folder(folder).and_then(
      [&] { return write_file(folder / "preset.toml", preset::to_toml(job.preset)); });
  if (!made) return made;
  record::FolderSink sink(folder, {job.preset.name, kind_of(pictures), job.preset.title});
  auto summary = run_job(job, pictures, threads, sink, progress.next_phase());
  if (!summary) {
    Error error = summary.error();
    if (error.fault == Fault::no_equilibrium)
      error.message += "\n" + help_for(job.preset, record::Limit::no_equilibrium);
    return tl::unexpected(error);
  }
  job.summary = *summary;
  job.summary.kind = kind_of(pictures);
  TRY(trajectory, sink.finish(job.summary));
  job.length_scale_mm = trajectory->layout.length_scale_mm;
  if (is_search(job.preset))
    if (auto written = record::write_state_tables(folder, job.states); !written) return written;
  if (pictures != Pictures::none)
    records.push_back({job.preset, std::move(*trajectory), job.states});
  return {};
}

// the pictures of one run by itself
Result<void> draw_alone(Job& job, Pictures pictures, const CaseRun& one, const SharedColourBar& bar,
                        const fs::path& folder, PictureMaker& artist, Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  const bool ends = pictures == Pictures::stills && stills_show_ends(job.preset);
  const auto draw = [&](const record::Trajectory& run) {
    return artist.draw(pictures, job.preset, run, bar, folder, progress.next_phase());
  };
  const auto draw_it = [&] {
    if (is_search(job.preset))
      return draw_states(one, artist.renderer(), folder / fs::path(job.preset.name).filename(),
                         progress.next_phase());
    return ends ? draw(ends_of(one.run)) : draw(one.run);
  };
  auto drawn = draw_it();
  job.summary.seconds_render +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return drawn;
}

// what shows several runs: movies and shells beside one another
Result<void> draw_together(const std::vector<Job>& jobs, const preset::Preset& base,
                           Pictures pictures, std::vector<CaseRun> records, PictureMaker& artist,
                           const fs::path& partial, Progress& progress) {
  if (drawn_beside(jobs.front(), pictures))
    return draw_beside(records, base.title, artist.renderer(), partial, progress.next_phase());
  return draw_case_figures(std::move(records), base.title, artist.renderer(),
                           partial / fs::path(base.name).filename(),
                           [&]() -> Watch& { return progress.next_phase(); });
}

// every picture: of each run by itself, then of all together, whose time they share
Result<void> draw_all(std::vector<Job>& jobs, const preset::Preset& base, Pictures pictures,
                      std::vector<CaseRun> records, PictureMaker& artist, const fs::path& partial,
                      Progress& progress) {
  if (!drawn_beside(jobs.front(), pictures)) {
    const auto bars = shared_bars(records, pictures);
    for (std::size_t k = 0; k < jobs.size(); ++k)
      if (auto drawn = draw_alone(jobs[k], pictures, records[k], bars[k],
                                  folder_of(partial, jobs[k].name), artist, progress);
          !drawn)
        return drawn;
  }
  const auto start = std::chrono::steady_clock::now();
  if (drawn_beside(jobs.front(), pictures) || pictures == Pictures::stills)
    if (auto drawn =
            draw_together(jobs, base, pictures, std::move(records), artist, partial, progress);
        !drawn)
      return drawn;
  const double together =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  for (Job& job : jobs) {
    job.summary.seconds_render += together / double(jobs.size());
    if (auto written =
            record::write_summary(folder_of(partial, job.name) / "summary.json", job.summary);
        !written)
      return written;
  }
  return {};
}

Result<void> do_jobs(std::vector<Job>& jobs, const preset::Presets& presets, Pictures pictures,
                     const Options& options, const fs::path& partial, Progress& progress) {
  const preset::Preset& base = presets.base;
  const bool cases = !jobs.front().name.empty();
  // of a run that is cut short it says which cases there are
  if (cases)
    if (auto said = write_file(partial / "preset.toml", preset::to_toml(presets)); !said)
      return said;
  std::optional<PictureMaker> artist;
  if (pictures != Pictures::none) {
    TRY(made, PictureMaker::create(options.context, options.threads, base.style.font));
    artist.emplace(std::move(*made));
  }
  std::vector<std::string> names;
  std::vector<record::Summary> summaries;
  std::vector<CaseRun> records;
  for (auto& job : jobs)
    if (auto ended = simulate(job, pictures, thread_count(options.threads),
                              folder_of(partial, job.name), progress, records);
        !ended)
      return ended;
  if (artist)
    if (auto drawn = draw_all(jobs, base, pictures, std::move(records), *artist, partial, progress);
        !drawn)
      return drawn;
  for (const auto& job : jobs) {
    names.push_back(job.name);
    summaries.push_back(job.summary);
  }
  if (!cases) return {};
  return write_file(partial / "summary.json", summary_of_cases(base.name, names, summaries));
}

std::string state_text(const record::Summary& at) {
  if (!at.solved) return "the net itself, no equilibrium";
  return fmt::format("bend energy {:.3f} mJ, {}, residual {:.1e} N", at.energies[Term::bend],
                     at.stable ? "stable" : fmt::format("{} negative pivots", at.negative_pivots),
                     at.residual_N);
}

void print_result(const Job& job, const fs::path& folder) {
  const auto& at = job.summary;
  fmt::print("{}: {} joints, {} cells; height {:.2f} mm, {}; {:.1f} s simulated",
             folder_of(folder, job.name).string(), at.joints, at.cells, at.height_mm,
             state_text(at), at.seconds_simulation);
  if (at.seconds_render > 0) fmt::print(", {:.1f} s drawn", at.seconds_render);
  if (!std::isnan(at.max_deviation))
    fmt::print(
        "\n  from its net: at most {:.3f} %, mean {:.3f} %, median {:.3f} %, nine tenths "
        "within {:.3f} % of {:.4g} mm",
        100 * at.max_deviation, 100 * at.mean_deviation, 100 * at.median_deviation,
        100 * at.deviation_p90, job.length_scale_mm);
  if (!std::isnan(at.max_seam_gap_mm))
    fmt::print("\n  {:.2f} mm from its blocks at most; seams: gap {:.2f} mm, kink {:.1f} degrees",
               at.max_deviation * job.length_scale_mm, at.max_seam_gap_mm, at.max_seam_kink_deg);
  // why it ended early is said as the error that it is
  if (!at.limit_reason.empty() && failure_of(at, true).empty())
    fmt::print("\n  on its way: {}", at.limit_reason);
  fmt::print("\n");
  if (is_search(job.preset)) fmt::print("{}", found_text(job.states));
  fmt::print("{}", how_to_make_movie(folder_of(folder, job.name), job.preset));
}

}  // namespace

std::string failure_of(const record::Summary& summary, bool allow_unstable) {
  // a shell that snapped and came to rest went on to the end
  if (summary.limit != record::Limit::none && summary.limit != record::Limit::snap)
    return fmt::format("the path ended early, limit \"{}\": {}", word_of(summary.limit),
                       summary.limit_reason);
  if (summary.solved && !summary.stable && !allow_unstable)
    return fmt::format(
        "ends in an unstable state with {} negative pivots; 'allow_unstable = true' "
        "accepts that",
        summary.negative_pivots);
  return "";
}

std::string summary_of_cases(const std::string& preset, const std::vector<std::string>& names,
                             const std::vector<record::Summary>& summaries) {
  Json all{{"preset", preset}, {"cases", Json::array()}};
  for (std::size_t k = 0; k < names.size(); ++k) {
    Json one{{"name", names[k]}};
    one.update(parsed(record::to_json(summaries[k])));
    all["cases"].push_back(std::move(one));
  }
  return text_of(all);
}

int produce(const Options& options, Pictures pictures) {
  const auto presets = load(options);
  if (!presets) return report(presets.error());
  if (options.print_config) {
    fmt::print("{}", preset::to_toml(*presets));
    return ExitCode::done;
  }
  auto jobs = jobs_of(*presets, pictures);
  const auto folder = output_of(options, presets->base);
  if (!jobs) {
    if (pictures == Pictures::stills) draw_refusals(*presets, folder);
    return report(jobs.error());
  }
  const int code = deliver(folder, phases_of(*jobs, pictures), options.quiet,
                           [&](const fs::path& partial, Progress& progress) {
                             return do_jobs(*jobs, *presets, pictures, options, partial, progress);
                           });
  if (code != ExitCode::done) return code;
  bool whole = true;
  for (const auto& job : *jobs) {
    if (!options.quiet) print_result(job, folder);
    const auto fault = failure_of(job.summary, job.preset.allow_unstable);
    if (!fault.empty()) std::fprintf(stderr, "%s: %s\n", job.preset.name.c_str(), fault.c_str());
    if (const auto help = help_for(job.preset, job.summary.limit); !help.empty())
      std::fprintf(stderr, "%s: %s\n", job.preset.name.c_str(), help.c_str());
    whole = whole && fault.empty();
  }
  return whole ? ExitCode::done : ExitCode::failed;
}

}  // namespace gridshell::app
