#include "app/cli/produce.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "app/cli/commands.h"
#include "app/cli/console.h"
#include "app/cli/delivery.h"
#include "app/cli/figures.h"
#include "app/cli/preset_library.h"
#include "app/cli/staged_folder.h"
#include "engine/core/file_io.h"
#include "engine/core/json.h"
#include "engine/core/text.h"
#include "engine/core/try.h"
#include "engine/gridshell.h"
#include "render/movie/stage.h"

namespace gridshell::app {
namespace fs = std::filesystem;
namespace {

tl::unexpected<Error> no_run(const fs::path& folder, const std::string& because) {
  return invalid("'{}' is no run: {}", folder.string(), because);
}

bool contains_run(const fs::path& folder) {
  std::error_code error;
  return fs::exists(folder / "summary.json", error) || record::preset_of_journal(folder);
}

// the cases of an interrupted run that were started
std::vector<std::string> cases_begun(const fs::path& folder) {
  std::vector<std::string> names;
  if (const auto presets = preset::read_preset_file(folder / "preset.toml"))
    for (const auto& one : presets->cases)
      if (contains_run(folder / one.name)) names.push_back(one.name);
  return names;
}

// text from a file of unknown origin, quoted and shortened so that it can be printed
std::string shown(const std::string& word) {
  const auto text = line_of(Json(word), true);
  return text.size() <= 80 ? text : text.substr(0, 77) + "...";
}

// the names of the cases, which are their folders; without cases one empty name
Result<std::vector<std::string>> case_names(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error))
    return no_run(folder, "a run is a folder that 'gridshell run PRESET -o FOLDER' writes");
  const auto file = folder / "summary.json";
  const auto text = read_file(file, largest_text);
  if (!text) {
    if (record::preset_of_journal(folder)) return std::vector<std::string>{""};
    if (auto begun = cases_begun(folder); !begun.empty()) return begun;
    return no_run(folder, text.error().message);
  }
  const auto json = parsed(*text);
  if (!json.is_object() || !json.contains("cases")) return std::vector<std::string>{""};
  std::vector<std::string> names;
  for (const auto& one : json["cases"]) {
    if (!one.is_object() || !one.contains("name") || !one["name"].is_string()) continue;
    const auto name = one["name"].get<std::string>();
    // it becomes the name of a folder that is written
    if (const auto wrong = preset::case_name_error(name); !wrong.empty())
      return invalid("'{}': case {}: {}", file.string(), shown(name), wrong);
    if (std::ranges::find(names, name) != names.end())
      return invalid("'{}': case \"{}\" is listed twice", file.string(), name);
    names.push_back(name);
  }
  if (names.empty()) return no_run(folder, "its summary.json lists no cases");
  return names;
}

// refuses a preset's name that cannot be the name of a picture
Result<void> check_name(const fs::path& file, const std::string& name) {
  const auto plain = [](unsigned char c) { return c >= 0x20 && c != 0x7f; };
  const auto stem = fs::path(name).filename().string();
  if (!stem.empty() && stem.size() <= 200 && stem.front() != '.' &&
      std::ranges::all_of(name, plain))
    return {};
  return invalid("'{}': its preset's name cannot be the name of a picture", file.string());
}

// version 0.1 did not save the kind of a run: one that has stills was made by `figure`
Pictures pictures_of(const Run& run, const fs::path& folder) {
  const auto still = fs::path(run.preset.name).filename().string() + ".png";
  std::error_code error;
  const bool stills = run.summary.kind == record::Kind::unknown
                          ? fs::exists(folder / still, error)
                          : run.summary.kind == record::Kind::figure;
  return stills ? Pictures::stills : Pictures::movie;
}

// the summary of an interrupted run, from its last frame
record::Summary summary_of(const record::Journal& journal, const preset::Preset& preset) {
  const record::Trajectory& run = journal.trajectory;
  record::Summary s;
  s.preset = journal.name.preset;
  s.kind = journal.name.kind;
  s.finished = false;
  const auto rod_model = preset::rod_model_of(preset);
  s.model = word_of(rod_model);
  s.model_reason = preset::model_reason(preset);
  s.solved = rod_model != RodModel::net;
  s.rods = int(run.layout.rods.size());
  s.joints = int(run.layout.joints.size());
  s.cells = int(run.layout.cells.size());
  s.take_state(run.frames.back());
  return s;
}

Result<void> read_journal(const fs::path& folder, Run& run) {
  TRY(journal, as_input(record::read_journal_of(folder)));
  const record::FrameList& frames = journal->trajectory.frames;
  if (frames.empty()) return no_run(folder, "no frame was finished");
  run.summary = summary_of(*journal, run.preset);
  run.trajectory = std::move(journal->trajectory);
  run.in_journal = true;
  return {};
}

Result<void> read_files(const fs::path& folder, bool no_checksum, Run& run) {
  TRY(summary, as_input(record::read_summary(folder / "summary.json")));
  TRY(trajectory,
      as_input(record::read_trajectory(folder / "trajectory.h5", {.no_checksum = no_checksum})));
  run.summary = std::move(*summary);
  run.trajectory = std::move(*trajectory);
  return {};
}

// measured; most of it is for the triangles of the tubes
constexpr double bytes_to_draw_a_node = 2000;

Result<void> check_memory(const fs::path& folder, const Run& run) {
  const record::FrameList& frames = run.trajectory.frames;
  if (frames.empty()) return no_run(folder, "its trajectory has no frame");
  const double requested = 1e-9 * bytes_to_draw_a_node * double(frames.front().nodes.cols());
  const double given =
      run.preset.accuracy.memory_GB > 0 ? run.preset.accuracy.memory_GB : default_memory_GB();
  if (given == 0 || requested <= given) return {};
  return invalid(
      "'{}': drawing its {} nodes takes about {:.2g} GB, more than the {:.2g} GB of [accuracy] "
      "memory_GB in '{}' (by default half of the machine's); a larger value in that file permits "
      "it",
      folder.string(), frames.front().nodes.cols(), requested, given,
      (folder / "preset.toml").string());
}

Result<record::StateTables> read_states_of(const fs::path& folder, const Run& run) {
  auto tables = as_input(record::read_state_tables(folder));
  if (tables && tables->rows.size() != run.trajectory.frames.size())
    return no_run(folder,
                  fmt::format("{} lists {} states, its trajectory has {}", record::states_name,
                              tables->rows.size(), run.trajectory.frames.size()));
  return tables;
}

Result<Run> read_run(const fs::path& folder, const std::string& name,
                     const std::vector<preset::Override>& overrides, bool no_checksum) {
  Run run;
  run.name = name;
  TRY(presets, preset::read_preset_file(folder / "preset.toml", overrides));
  run.preset = std::move(presets->base);
  std::error_code error;
  const bool whole = fs::exists(folder / "summary.json", error);
  TRY(read, whole ? read_files(folder, no_checksum, run) : read_journal(folder, run));
  TRY_DO(check_name(folder / (whole ? "summary.json" : record::journal_name), run.summary.preset));
  TRY_DO(check_memory(folder, run));
  run.preset.name = run.summary.preset;
  run.pictures = pictures_of(run, folder);
  if (run.preset.jitter.requested()) {
    TRY(tables, read_states_of(folder, run));
    run.states = std::move(*tables);
    run.pictures = Pictures::stills;
  }
  run.preset.movie.frames = int(run.trajectory.frames.size());
  return run;
}

bool is_picture(const fs::path& path) {
  const auto kind = path.extension();
  return path.filename() == "frames" || kind == ".png" || kind == ".svg" || kind == ".pdf" ||
         kind == ".mp4" || kind == ".webm" || kind == ".gif";
}

// copies everything of a run except pictures and hidden files, which may be half-written
Result<void> copy_data(const fs::path& from, const fs::path& to) {
  std::error_code error;
  for (fs::directory_iterator at(from, error), end; !error && at != end; at.increment(error)) {
    const auto name = at->path().filename();
    if (!at->is_regular_file(error) || at->is_symlink(error) || is_picture(name) ||
        name.string().starts_with('.') || name == manifest_name)
      continue;
    fs::copy_file(at->path(), to / name, fs::copy_options::overwrite_existing, error);
    if (!error) continue;
    // the library reports a full disk as an input/output error
    std::error_code other;
    if (error == std::errc::io_error && fs::space(to, other).available < at->file_size(other))
      error = std::make_error_code(std::errc::no_space_on_device);
    break;
  }
  if (!error) return {};
  return fail(Fault::io, "cannot copy '{}' to '{}': {}", from.string(), to.string(),
              error.message());
}

// writes the files of a run's folder except the pictures
Result<void> write_data(Run& run, const fs::path& from, const fs::path& to) {
  if (run.in_journal) {
    TRY(text, read_file(from / "preset.toml"));
    TRY_DO(write_file(to / "preset.toml", *text));
    TRY_DO(record::write_run(to, run.trajectory, run.summary));
  } else {
    TRY_DO(copy_data(from, to));
  }
  run.summary.kind = run.pictures == Pictures::stills ? record::Kind::figure : record::Kind::movie;
  return record::write_summary(to / "summary.json", run.summary);
}

Result<void> render_runs(std::vector<Run>& runs, const Options& options, const fs::path& to,
                         Progress& progress) {
  const fs::path from = options.input, name = runs.front().summary.preset;
  const bool cases = !runs.front().name.empty();
  auto stem = cases ? name.parent_path().filename() : name.filename();
  if (stem.empty()) stem = from.filename();
  // pictures of all cases have the title of the preset that lists them, else the name of the folder
  const auto listing = preset::read_preset_file(from / "preset.toml", {});
  const bool titled = listing && !listing->base.title.empty();
  TRY(maker, PictureMaker::create(options.context, runs.front().preset.style.font));
  for (Run& run : runs) run.summary.seconds_render = 0;
  TRY_DO(draw_all(runs, titled ? listing->base.title : stem.string(), stem, maker->renderer(), to,
                  progress));
  for (Run& run : runs) TRY_DO(write_data(run, folder_of(from, run.name), folder_of(to, run.name)));
  return cases ? copy_data(from, to) : Result<void>{};
}

/// Draws a movie in which the camera turns once around the last state. The last frame is one step
/// before the first, so that the movie can be repeated.
Result<void> draw_turntable(const Run& run, int frames, render::Renderer& renderer,
                            const fs::path& folder, Watch& watch) {
  record::Trajectory last{run.trajectory.layout, {}};
  last.frames = {record::Frame(run.trajectory.frames.back())};
  if (const auto& fault = run.trajectory.frames.fault()) return tl::unexpected(*fault);
  render::MovieStyle style = style_of(run.preset, Pictures::movie);
  style.view = preset::View::free;
  style.turn_deg = 360.0 * (frames - 1) / frames;
  TRY_DO(render::check_showable(last, style));
  const record::Frame first(run.trajectory.frames.front());
  render::RunSummary survey = render::summarise_run(last, &first);
  survey.frames = frames;
  survey.turn_deg = style.turn_deg;
  const render::FrameSource source{&last.layout, frames, [&](int) -> Result<record::Frame> {
                                     return record::Frame(last.frames.front());
                                   }};
  return make_movie(folder, run.preset, style, frames, watch,
                    [&](const render::FrameCallback& seen) {
                      return render::write_movie(source, survey, style, std::nullopt, renderer,
                                                 folder / "frames", watch, seen);
                    });
}

Result<int> render(const Options& options, bool no_checksum) {
  TRY(overrides, overrides_of_run(options));
  TRY(runs, read_runs(options.input, *overrides, no_checksum));
  for (const Run& run : *runs)
    if (!run.summary.finished)
      fmt::print(stderr, "'{}' is not finished: {}\n", folder_of(options.input, run.name).string(),
                 progress_text(run));
  const fs::path folder = options.output.empty() ? fs::path(options.input) : options.output;
  // the manifest still names the command that computed the run, so that `run` or `movie` may
  // replace it
  std::string maker = maker_of(options.input);
  if (maker.empty()) maker = word_of(runs->front().summary.kind);
  std::error_code other;
  if (maker == "design" && fs::equivalent(options.input, folder, other))
    return invalid(
        "'{}' has pictures of a design, of which 'gridshell render' draws the last state alone, "
        "expected another folder: -o",
        options.input);
  if (maker == "design") maker = word_of(runs->front().summary.kind);
  TRY_DO(deliver({folder, maker}, drawing_phases(*runs), options.quiet,
                 [&](const fs::path& partial, Progress& progress) {
                   return render_runs(*runs, options, partial, progress);
                 }));
  if (options.quiet) return ExitCode::done;
  for (const Run& run : *runs) {
    const auto of_run = folder_of(folder, run.name);
    fmt::print("{}: {:.1f} s drawn\n{}", of_run.string(), run.summary.seconds_render,
               how_to_make_movie(of_run, run.preset));
  }
  return ExitCode::done;
}

}  // namespace

Result<std::vector<Run>> read_runs(const fs::path& folder,
                                   const std::vector<preset::Override>& overrides,
                                   bool no_checksum) {
  TRY(names, case_names(folder));
  std::vector<Run> runs;
  for (const auto& name : *names) {
    // the last of several interrupted cases may have no frame yet
    if (!name.empty() && !contains_run(folder / name)) continue;
    TRY(run, read_run(folder_of(folder, name), name, overrides, no_checksum));
    runs.push_back(std::move(*run));
  }
  if (runs.empty()) return no_run(folder, "none of its cases is there");
  return runs;
}

Result<int> turntable(const Options& options) {
  Options looks = options;
  looks.frames.clear();
  TRY(overrides, overrides_of_run(looks));
  TRY(runs, read_runs(options.input, *overrides, false));
  const auto frames = options.frames.empty() ? std::optional(preset::Movie{}.frames)
                                             : parse_number<int>(options.frames);
  if (!frames || *frames < 2 || *frames > 100000)
    return invalid("--frames: got {}, expected 2 to 100000", options.frames);
  const fs::path folder =
      options.output.empty() ? next_to(options.input, "_turntable") : options.output;
  TRY_DO(check_outside_runs(folder));
  std::vector<Phase> phases;
  for (Run& run : *runs) {
    run.preset.movie.frames = *frames;
    phases.push_back(drawing("drawing", expected_seconds(Pictures::movie, run.preset)));
  }
  TRY(maker, PictureMaker::create(options.context, runs->front().preset.style.font));
  const auto work = [&](const fs::path& partial, Progress& progress) -> Result<void> {
    for (const Run& run : *runs) {
      const fs::path to = folder_of(partial, run.name);
      TRY_DO(make_folder(to));
      TRY_DO(draw_turntable(run, *frames, maker->renderer(), to, progress.next_phase()));
    }
    return {};
  };
  TRY_DO(deliver({folder, "turntable"}, phases, options.quiet, work));
  if (options.quiet) return ExitCode::done;
  for (const Run& run : *runs)
    fmt::print("{}: {} frames\n{}", folder_of(folder, run.name).string(), *frames,
               how_to_make_movie(folder_of(folder, run.name), run.preset));
  return ExitCode::done;
}

std::string progress_text(const Run& run) {
  const record::FrameList& frames = run.trajectory.frames;
  double furthest = 0;
  for (const record::Frame& frame : frames) furthest = std::max(furthest, frame.progress);
  return fmt::format("{}, up to progress {:.3g}", counted(frames.size(), "frame"), furthest);
}

// `gridshell render RUN`: pictures of a finished run, without simulating again.

void add_render(CommandLine& program) {
  const auto options = std::make_shared<Options>();
  const auto no_checksum = std::make_shared<bool>(false);
  CommandArguments command =
      program.add("render", "pictures of a finished run, without simulating again",
                  [options, no_checksum] { return render(*options, *no_checksum); });
  command.option("RUN", options->input, "the folder of a finished run").required();
  add_changes(command, *options);
  add_work_options(command, *options, "folder to write, by default RUN itself");
  add_picture_options(command, *options);
  add_no_checksum(command, *no_checksum);
}

}  // namespace gridshell::app
