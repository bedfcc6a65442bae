#include "app/cli/produce.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "app/cli/console.h"
#include "app/cli/delivery.h"
#include "app/cli/figures.h"
#include "app/cli/paper_page.h"
#include "app/cli/preset_library.h"
#include "app/cli/staged_folder.h"
#include "engine/core/file_io.h"
#include "engine/core/json.h"
#include "engine/core/parallel.h"
#include "engine/core/try.h"

namespace gridshell::app {
namespace fs = std::filesystem;
namespace {

// the runs of a preset; appends to `phases` one for the simulation of each
Result<std::vector<Run>> planned(const preset::Presets& presets, Pictures pictures,
                                 std::vector<Phase>& phases) {
  std::vector<Run> runs;
  if (pictures == Pictures::stills) TRY_DO(check_page(runs_of(presets)));
  for (const preset::Case& one : runs_of(presets)) {
    const preset::Preset& preset = one.preset;
    if (preset.jitter.requested() && pictures == Pictures::movie)
      return invalid(
          "{}: a search for states ([jitter] trials or confined above 0) has no movie; "
          "'gridshell figure' draws the states, [jitter] trials = 0 and confined = 0 make "
          "the actuation's movie",
          preset.name);
    TRY(plan, plan_of(preset));
    // if the engine gives no estimate: the first equilibrium, and some milliseconds per frame
    const double guess = std::isnan(plan->expected_seconds) ? 0.5 + 0.01 * preset.movie.frames
                                                            : plan->expected_seconds;
    phases.push_back({"simulating" + (one.name.empty() ? "" : " " + one.name), guess});
    runs.push_back({.name = one.name,
                    .preset = preset,
                    .pictures = pictures,
                    .scene = std::move(plan->scene)});
  }
  return runs;
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

// what a user may change if a run ended before the end of its path; empty if nothing is known
std::string help_for(const preset::Preset& preset, record::Limit limit, double largest_strain) {
  const bool pushes = preset.indentation.requested() || !preset.step.empty();
  const std::string less = preset.indentation.requested() ? "less [indentation] depth"
                           : !preset.step.empty() ? "a smaller depth_mm, angle or load there"
                           : preset.loads.any()   ? "less load or a larger actuated boundary"
                                                  : "a larger actuated boundary";
  switch (limit) {
    case record::Limit::none:
    case record::Limit::snap:
      return "";
    case record::Limit::locking:
      // a push may also end where the shell becomes too stiff
      if (pushes && !locked_by_strain(largest_strain, preset.limits.max_strain))
        return less + " ends before that";
      return less + " ends before that, more [limits] max_strain after it";
    case record::Limit::strength:
      return less + " ends before that, more of that limit after it";
    case record::Limit::contact:
      return "[limits] contact = \"tell\" continues and reports what touches";
    case record::Limit::branch_lost:
    case record::Limit::no_equilibrium:
      break;
  }
  if (preset.actuation.start == preset::Start::net)
    return "what may help: --set actuation.start=flat, the path from the flat footprint";
  if (preset.contact.model == preset::ContactModel::barrier)
    return "what may help: a wider [contact] gap_mm, or more stiffness_N_per_mm";
  const int edges = preset.accuracy.edges_per_segment;
  return fmt::format("what may help: --set accuracy.edges_per_segment={}{}",
                     edges == 0 ? 16 : 2 * edges,
                     edges == 0 ? ", which asks for no tolerance" : "");
}

// computes one run: a path, or a search for states
Result<record::Summary> computed(Run& run, int threads, const fs::path& segments,
                                 record::Sink& sink, Watch& watch) {
  if (!run.preset.jitter.requested()) {
    RunContext context{std::make_shared<Team>(threads), nullptr};
    if (!segments.empty()) context.segments = std::make_shared<simulate::SavedSegments>(segments);
    return simulate::run(run.preset, std::exchange(run.scene, nullptr),
                         run.pictures == Pictures::stills, sink, watch, context);
  }
  TRY(search, study::run_states(run.preset, threads, sink, watch));
  run.states = std::move(search->tables);
  return search->summary;
}

// simulates one run; every frame is written as soon as it is found, and pictures are drawn only
// when all runs are complete
Result<void> simulate(Run& run, int threads, const fs::path& folder, const fs::path& segments,
                      Watch& watch) {
  TRY_DO(make_folder(folder));
  TRY_DO(write_file(folder / "preset.toml", saved_preset(preset::to_toml(run.preset))));
  const record::Kind kind = kind_of(run.pictures);
  record::FolderSink sink(folder, {run.preset.name, kind, run.preset.title});
  auto summary = computed(run, threads, segments, sink, watch);
  if (!summary && summary.error().fault == Fault::no_equilibrium)
    summary.error().message += "\n" + help_for(run.preset, record::Limit::no_equilibrium, NAN);
  if (!summary) return tl::unexpected(summary.error());
  run.summary = *summary;
  run.summary.kind = kind;
  TRY(trajectory, sink.finish(run.summary));
  if (run.preset.jitter.requested()) TRY_DO(record::write_state_tables(folder, run.states));
  run.trajectory = std::move(*trajectory);
  if (run.pictures == Pictures::none) run.trajectory.frames = {};
  return {};
}

// summary.json of several cases: the preset's name, and for each case its name (that of its folder)
// and its summary
std::string summary_of_cases(const std::string& preset, const std::vector<Run>& runs) {
  Json all{{"preset", preset}, {"cases", Json::array()}};
  for (const Run& run : runs) {
    Json one{{"name", run.name}};
    one.update(parsed(record::to_json(run.summary)));
    all["cases"].push_back(std::move(one));
  }
  return gridshell::text_of(all);
}

Result<void> write_runs(std::vector<Run>& runs, const preset::Presets& presets,
                        const Options& options, const fs::path& partial, Progress& progress) {
  const preset::Preset& base = presets.base;
  const bool cases = !runs.front().name.empty();
  // written first: from this file an interrupted run is read with its cases
  if (cases) TRY_DO(write_file(partial / "preset.toml", saved_preset(preset::to_toml(presets))));
  std::optional<PictureMaker> maker;
  if (runs.front().pictures != Pictures::none) {
    TRY(made, PictureMaker::create(options.context, base.style.font));
    maker.emplace(std::move(*made));
  }
  const fs::path segments = maker ? fs::path() : partial / segments_name;
  if (!maker) {
    TRY_DO(make_folder(segments));
    TRY_DO(write_file(segments / version_name, build_id()));
  }
  for (Run& run : runs)
    TRY_DO(simulate(run, thread_count(options.threads), folder_of(partial, run.name),
                    maker ? segments : folder_of(segments, run.name), progress.next_phase()));
  std::error_code ignored;
  if (!maker) fs::remove_all(segments, ignored);
  if (maker) {
    TRY_DO(draw_all(runs, base.title, fs::path(base.name).filename(), maker->renderer(), partial,
                    progress));
    for (const Run& run : runs)
      TRY_DO(record::write_summary(folder_of(partial, run.name) / "summary.json", run.summary));
  }
  return cases ? write_file(partial / "summary.json", summary_of_cases(base.name, runs))
               : Result<void>{};
}

std::string state_text(const record::Summary& at) {
  if (!at.solved) return "the net itself, no equilibrium";
  constexpr double worth_reporting = 0.01, least_mJ = 1e-6;
  // without the potential of the loads, whose zero is arbitrary
  const double bend = at.energies[Term::bend], all = at.energies.total() - at.energies[Term::load];
  return fmt::format(
      "bend energy {}{}, {}, residual {:.1e} N", record::with_error(bend, at.energy_error_mJ, "mJ"),
      std::abs(all - bend) > worth_reporting * std::max(std::abs(bend), least_mJ)
          ? " of " + record::with_error(all, at.energy_error_mJ, "mJ") + " of elastic energy"
          : "",
      at.stable                ? "stable"
      : at.negative_pivots < 0 ? "stability not known"
                               : fmt::format("{} negative pivots", at.negative_pivots),
      at.residual_N);
}

/// "[-1, -1], 14.1 mm from the middle of the footprint": the joint nearest to the requested point
/// may be far from it.
std::string pushed_text(const record::Summary& at, const record::Layout& layout) {
  for (const record::Joint& joint : layout.joints)
    if (at.pushed_joint == fmt::format("[{}, {}]", joint.i, joint.j))
      return fmt::format("{}, {:.3g} mm from the middle of the footprint", at.pushed_joint,
                         std::hypot(joint.u_mm, joint.v_mm));
  return at.pushed_joint;
}

/// Prints forces in the digits that their errors allow.
void print_forces(const record::Summary& at, const record::Layout& layout) {
  if (!at.pushed_joint.empty()) fmt::print("\n  pushed at joint {}", pushed_text(at, layout));
  if (std::isfinite(at.force_N))
    fmt::print("\n  force of the push {}", record::with_error(at.force_N, at.push_error_N, "N"));
  if (std::isfinite(at.force_N) && std::isfinite(at.stiffness_N_per_mm))
    fmt::print(", growing by {}",
               record::with_error(at.stiffness_N_per_mm, at.stiffness_error_N_per_mm, "N/mm"));
  if (at.force_error_N >= at.largest_force_N && at.largest_force_N > 0)
    fmt::print("\n  no force on a support above {:.1g} N", at.largest_force_N + at.force_error_N);
  else if (at.largest_force_N > 0)
    fmt::print("\n  largest force on a support {}",
               record::with_error(at.largest_force_N, at.force_error_N, "N"));
}

/// Prints the largest stress; for rods without a strength the largest bending strain, if no limit
/// for it is set.
void print_strength(const record::Summary& at, const preset::Limits& limits) {
  constexpr double worth_reporting = 0.01;
  if (std::isfinite(at.utilisation))
    return fmt::print("\n  {}, in {}; the largest stress is {:.4g} MPa",
                      at.utilisation > 1
                          ? at.breaking()
                          : fmt::format("stress at most {:.3g} of the strength", at.utilisation),
                      at.stress_at, at.largest_stress_MPa);
  if (limits.max_bending_strain > 0 || !(at.largest_bending_strain >= worth_reporting)) return;
  fmt::print(
      "\n  bending strains a rod by {:.2g} % ({}): most materials do not bear 1 %, superelastic "
      "wire bears some 6 %; [limits] max_bending_strain ends the path there",
      100 * at.largest_bending_strain, at.bending_strain_at);
}

void print_result(const Run& run, const fs::path& folder) {
  const auto& at = run.summary;
  const double scale_mm = run.trajectory.layout.length_scale_mm;
  fmt::print("{}: {} joints, {} cells; height {:.2f} mm, {}; {:.1f} s simulated",
             folder_of(folder, run.name).string(), at.joints, at.cells, at.height_mm,
             state_text(at), at.seconds_simulation);
  if (at.seconds_render > 0) fmt::print(", {:.1f} s drawn", at.seconds_render);
  if (!std::isnan(at.max_deviation))
    fmt::print(
        "\n  from its net: at most {:.3f} %, mean {:.3f} %, median {:.3f} %, nine tenths "
        "within {:.3f} % of {:.4g} mm",
        100 * at.max_deviation, 100 * at.mean_deviation, 100 * at.median_deviation,
        100 * at.deviation_p90, scale_mm);
  if (!std::isnan(at.max_seam_gap_mm))
    fmt::print("\n  {:.2f} mm from its blocks at most; seams: gap {:.2f} mm, kink {:.1f} degrees",
               at.max_deviation * scale_mm, at.max_seam_gap_mm, at.max_seam_kink_deg);
  print_forces(at, run.trajectory.layout);
  print_strength(at, run.preset.limits);
  // if the path ended early, the reason is printed as an error
  if (!at.limit_reason.empty() && failure_of(at, true).empty())
    fmt::print("\n  on its path: {}", at.limit_reason);
  // the reason has what meshes do not confirm
  if (!at.doubt.empty() && at.limit_reason.find(at.doubt) == std::string::npos)
    fmt::print("\n  doubt: {}", at.doubt);
  if (!at.contact.empty()) fmt::print("\n  contact: {}", at.contact);
  if (at.contacts > 0)
    fmt::print("\n  its last state has {} interpenetration{}: rods overlap there{}", at.contacts,
               at.contacts > 1 ? "s" : "",
               run.preset.contact.model == preset::ContactModel::barrier
                   ? ""
                   : ", and contact is not modelled");
  fmt::print("\n");
  if (run.preset.jitter.requested()) fmt::print("{}", found_text(run.states));
  fmt::print("{}", how_to_make_movie(folder_of(folder, run.name), run.preset));
}

bool is_of(const fs::path& folder, const std::string& presets) {
  const auto text = read_file(folder / "preset.toml", largest_text);
  return text && without_version(*text) == presets;
}

/// The exit code of the finished run of these presets in `folder`, after printing why it failed;
/// nothing if it is no such run.
std::optional<int> finished(const fs::path& folder, const std::string& presets,
                            const std::vector<Run>& runs) {
  if (!is_of(folder, presets)) return std::nullopt;
  std::vector<std::string> failures;
  for (const Run& run : runs) {
    const auto summary = record::read_summary(folder_of(folder, run.name) / "summary.json");
    if (!summary || !summary->finished || summary->kind != kind_of(run.pictures))
      return std::nullopt;
    if (auto failure = failure_of(*summary, run.preset.allow_unstable); !failure.empty())
      failures.push_back(fmt::format("{}: {}\n", run.preset.name, failure));
  }
  fmt::print(stderr, "{}", fmt::join(failures, ""));
  return failures.empty() ? ExitCode::done : ExitCode::failed;
}

/// The folder that an interrupted run of these presets left; empty if there is no run yet. Errors
/// (bad_input): there is only a run of another preset, of other keys or by another build.
Result<fs::path> unfinished_run(const fs::path& folder, const std::string& presets) {
  std::string why;
  if (fs::exists(folder / "summary.json")) {
    if (const auto refused = refusal_to_write(folder, "run"); !refused.empty())
      return invalid("--resume: '{}': {}", folder.string(), refused);
    why = fmt::format("'{}' is a finished run of another preset, or of this one with other keys",
                      folder.string());
  }
  for (const fs::path& left : left_behind(folder)) {
    const auto made_by = read_file(left / segments_name / version_name, largest_text);
    if (!made_by) continue;
    if (!is_of(left, presets))
      why = fmt::format("'{}' is a run of another preset, or of this one with other keys",
                        left.string());
    else if (*made_by != build_id())
      why = fmt::format("'{}' was begun by another build of this program, {}, and this is {}",
                        left.string(), *made_by, build_id());
    else
      return left;
  }
  if (why.empty()) return fs::path();
  return invalid("--resume: {}: without it the run starts again", why);
}

}  // namespace

std::string failure_of(const record::Summary& summary, bool allow_unstable) {
  // after a snap-through the path continued to its end
  if (summary.limit != record::Limit::none && summary.limit != record::Limit::snap)
    return fmt::format("the path ended early, limit \"{}\": {}", word_of(summary.limit),
                       summary.limit_reason);
  if (summary.solved && !summary.stable && !allow_unstable)
    return fmt::format(
        "ends in an unstable state with {} negative pivots; 'allow_unstable = true' "
        "accepts that",
        summary.negative_pivots);
  if (!summary.tolerance_met) return summary.doubt;
  return "";
}

Result<int> produce(const Options& options, Pictures pictures) {
  TRY(presets, load(options));
  if (options.print_config) return print_config(*presets);
  const std::string command(word_of(kind_of(pictures)));
  // a folder of its own, so that it does not replace the run or movie, which has more frames
  const auto folder =
      output_of(options, presets->base, pictures == Pictures::stills ? "_figure" : "");
  for (const std::string& note : presets->notes)
    if (!options.quiet) fmt::print(stderr, "{}: note: {}\n", presets->base.name, note);
  std::vector<Phase> phases;
  auto runs = planned(*presets, pictures, phases);
  if (!runs) {
    if (pictures == Pictures::stills) draw_refusals(*presets, output_of(options, presets->base));
    return tl::unexpected(runs.error());
  }
  for (Phase& phase : drawing_phases(*runs)) phases.push_back(std::move(phase));
  fs::path left;
  if (options.resume) {
    const std::string text = runs->front().name.empty() ? preset::to_toml(runs->front().preset)
                                                        : preset::to_toml(*presets);
    if (const auto code = finished(folder, text, *runs)) {
      if (!options.quiet) fmt::print("{}: is finished already\n", folder.string());
      return *code;
    }
    TRY(found, unfinished_run(folder, text));
    left = std::move(*found);
  }
  const auto work = [&](const fs::path& partial, Progress& progress) {
    return write_runs(*runs, *presets, options, partial, progress);
  };
  TRY_DO(deliver({folder, command}, phases, options.quiet, work, left));
  bool whole = true;
  for (const Run& run : *runs) {
    if (!options.quiet) print_result(run, folder);
    const auto fault = failure_of(run.summary, run.preset.allow_unstable);
    // a step that cannot begin says itself what is expected
    const auto help = run.summary.limit_reason.starts_with("[[step]]")
                          ? std::string()
                          : help_for(run.preset, run.summary.limit, run.summary.largest_strain);
    for (const auto& text : {fault, help})
      if (!text.empty()) fmt::print(stderr, "{}: {}\n", run.preset.name, text);
    whole = whole && fault.empty();
  }
  return whole ? ExitCode::done : ExitCode::failed;
}

}  // namespace gridshell::app
