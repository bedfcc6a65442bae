#include "app/designs.h"

#include <fmt/format.h>

#include "app/console.h"
#include "app/delivery.h"
#include "app/design_files.h"
#include "app/design_pictures.h"
#include "app/loading.h"
#include "app/pictures.h"
#include "app/production.h"
#include "engine/core/atomic_file.h"
#include "engine/preset/writer.h"
#include "engine/record/folder_sink.h"

namespace gridshell::app {
namespace fs = std::filesystem;
namespace {

constexpr double same_state = 4;  // tolerances of the run: how far apart two runs of one state are

/// The one run that is designed. Errors: a preset of several cases.
Result<preset::Preset> one_of(const Options& options) {
  const auto presets = load(options);
  if (!presets) return tl::unexpected(presets.error());
  if (presets->cases.empty()) return presets->base;
  return fail(Fault::bad_input, fmt::format("{}: a preset of several cases; design takes one shell",
                                            presets->base.name));
}

/// The final state of a preset, kept in memory.
Result<record::Trajectory> end_of(const preset::Preset& preset, Watch& watch) {
  auto outcome = experiment::run(preset, true, watch);
  if (!outcome) return tl::unexpected(outcome.error());
  return std::move(outcome->trajectory);
}

/// The designed shell as a run of its own.
Result<record::Trajectory> run_designed(const preset::Preset& preset, const fs::path& folder,
                                        record::Summary& summary, Watch& watch) {
  record::FolderSink sink(folder, {preset.name, record::Kind::figure, preset.title});
  auto run = experiment::run(preset, true, sink, watch);
  if (!run) return tl::unexpected(run.error());
  summary = *run;
  summary.kind = record::Kind::figure;
  return sink.finish(summary);
}

/// Whether the patient way from the flat ends in the same state.
FromFlat from_flat(preset::Preset preset, const record::Trajectory& designed, Watch& watch) {
  preset.actuation.start = preset::Start::flat;
  const auto outcome = experiment::run(preset, true, watch);
  FromFlat found;
  if (!outcome) {
    found.why = outcome.error().message;
    return found;
  }
  if (outcome->trajectory.frames.size() == 0 || outcome->trajectory.frames.back().progress < 1) {
    found.why = outcome->summary.limit_reason;
    return found;
  }
  const auto joints = long(designed.layout.joints.size());
  const Eigen::Matrix3Xd there = outcome->trajectory.frames.back().nodes.leftCols(joints),
                         here = designed.frames.back().nodes.leftCols(joints);
  found.off_mm = (there - here).colwise().norm().maxCoeff();
  found.reached =
      found.off_mm < same_state * preset.accuracy.tolerance * designed.layout.length_scale_mm;
  if (!found.reached) found.why = fmt::format("it ends {:.3g} mm away", found.off_mm);
  return found;
}

/// Everything between the preset and its folder.
Result<void> work(const preset::Preset& preset, const Options& options, const fs::path& folder,
                  Progress& progress, record::Summary& summary, std::string& text) {
  auto found = design(preset, progress.next_phase());
  if (!found) return tl::unexpected(found.error());
  preset::Preset designed = preset;
  designed.ends.table = found->table;
  if (found->largest_thickening > 0) designed.rod_table = found->rod_table;
  auto before = end_of(preset, progress.next_phase());
  if (!before) return tl::unexpected(before.error());
  auto after = run_designed(designed, folder, summary, progress.next_phase());
  if (!after) return tl::unexpected(after.error());
  Watch& last = progress.next_phase();
  const FromFlat flat = from_flat(designed, *after, last);
  if (last.cancelled()) return stopped();
  text = design_text(*found, flat);
  return write_design(folder, designed, *found, flat).and_then([&] {
    auto artist = Artist::create(options.context, options.threads, preset.style.font);
    if (!artist) return Result<void>(tl::unexpected(artist.error()));
    return draw_design({preset, std::move(*before), {}, "before"},
                       {designed, std::move(*after), {}, "designed"}, *found, artist->renderer(),
                       folder / fs::path(preset.name).filename(), progress.next_phase());
  });
}

}  // namespace

int produce_design(const Options& options) {
  const auto preset = one_of(options);
  if (!preset) return report(preset.error());
  if (options.print_config) {
    fmt::print("{}", preset::to_toml(*preset));
    return ExitCode::done;
  }
  const auto folder =
      options.output.empty() ? fs::path("out") / (preset->name + "_design") : options.output;
  const std::vector<Phase> phases{{"designing", 5},
                                  {"simulating before", 1},
                                  {"simulating after", 1},
                                  {"from the flat", 2},
                                  {"drawing", 2 * expected_seconds(Pictures::stills, *preset)}};
  record::Summary summary;
  std::string text;
  const int code =
      deliver(folder, phases, options.quiet, [&](const fs::path& partial, Progress& progress) {
        return work(*preset, options, partial, progress, summary, text);
      });
  if (code != ExitCode::done) return code;
  if (!options.quiet) fmt::print("{}: {}", folder.string(), text);
  const auto fault = shortcoming(summary, preset->allow_unstable);
  if (!fault.empty()) std::fprintf(stderr, "%s: %s\n", preset->name.c_str(), fault.c_str());
  return fault.empty() ? ExitCode::done : ExitCode::failed;
}

}  // namespace gridshell::app
