// Pictures of a design: the shell before and after, over its target, and how it came there.

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "app/cli/commands.h"
#include "app/cli/console.h"
#include "app/cli/delivery.h"
#include "app/cli/design_files.h"
#include "app/cli/figures.h"
#include "app/cli/options.h"
#include "app/cli/pictures.h"
#include "app/cli/preset_library.h"
#include "app/cli/produce.h"
#include "engine/core/file_io.h"
#include "engine/core/result.h"
#include "engine/core/try.h"
#include "engine/core/watch.h"
#include "engine/gridshell.h"
#include "render/canvas/plot.h"
#include "render/gl/renderer.h"

namespace gridshell::app {

/// `<stem>_net.png`, `<stem>_deviation.png` and the plots of shells on nets, the target in the
/// place of the net: of every node its nearest point; `<stem>_convergence`. Errors: as
/// draw_net_pictures.
Result<void> draw_design(CaseRun before, CaseRun after, const DesignResult& found,
                         render::Renderer& renderer, const std::filesystem::path& stem,
                         Watch& watch);

namespace fs = std::filesystem;
namespace {

/// Distances of the joints over the iterations, per cent of the length scale; crosses: refused.
render::Plot convergence_plot(const DesignResult& found, const std::string& title) {
  render::Series largest{"largest"}, mean{"mean"}, refused{"step refused"};
  largest.colour = render::series_colour(0);
  mean.colour = render::series_colour(1);
  largest.marker = mean.marker = render::Marker::circle;
  refused.colour = {0.3f, 0.3f, 0.3f, 1};
  refused.marker = render::Marker::cross;
  refused.line_width = 0;
  render::Plot plot;
  const double percent = 100 / found.length_scale_mm;
  double norm = 2;
  for (std::size_t k = 0; k < found.steps.size(); ++k) {
    const DesignStep& step = found.steps[k];
    largest.x.push_back(step.iteration);
    largest.y.push_back(percent * step.max_mm);
    mean.x.push_back(step.iteration);
    mean.y.push_back(percent * step.mean_mm);
    if (k > 0 && !step.taken) {
      refused.x.push_back(step.iteration);
      refused.y.push_back(percent * step.max_mm);
    }
    if (step.norm == norm) continue;
    plot.references.push_back({false, step.iteration - 0.5, fmt::format("*p* = {:g}", step.norm)});
    norm = step.norm;
  }
  plot.title = title;
  plot.x.label = "iteration";
  plot.y.label = "distance of joints (% of *ρ*)";
  plot.y.logarithmic = true;
  plot.series = {largest, mean};
  if (!refused.x.empty()) plot.series.push_back(refused);
  return plot;
}

/// A run whose net is what it is to meet: of every node the nearest point of the target.
Result<void> put_target(CaseRun& one) {
  TRY(nearest, nearest_to(one.preset, one.run.layout.flat_nodes, one.run.frames.back().nodes));
  one.run.layout.net_nodes = std::move(*nearest);
  return {};
}

}  // namespace

Result<void> draw_design(CaseRun before, CaseRun after, const DesignResult& found,
                         render::Renderer& renderer, const fs::path& stem, Watch& watch) {
  std::vector<CaseRun> records;
  for (CaseRun* one : {&before, &after}) {
    if (auto put = put_target(*one); !put) return put;
    records.push_back(std::move(*one));
  }
  const auto style = style_of(records.front().preset, Pictures::stills);
  fs::path convergence = stem;
  convergence += "_convergence";
  return draw_net_pictures(records, renderer, stem, watch).and_then([&] {
    return render::write_plot(convergence, convergence_plot(found, render::plain(style.title)),
                              style.print);
  });
}

// The work behind `design`: the ends of a shell moved, the designed shell as a run, what was moved,
// and pictures of before and after.

/// Designs the shell of a preset and writes its folder. The exit code.
int produce_design(const Options& options);

namespace fs = std::filesystem;
namespace {

constexpr double same_state = 4;  // tolerances of the run: how far apart two runs of one state are

/// The one run that is designed. Errors: a preset of several cases.
Result<preset::Preset> one_of(const Options& options) {
  TRY(presets, load(options));
  if (presets->cases.empty()) return presets->base;
  return fail(Fault::bad_input, fmt::format("{}: a preset of several cases; design takes one shell",
                                            presets->base.name));
}

/// The final state of a preset, kept in memory.
Result<record::Trajectory> end_of(const preset::Preset& preset, Watch& watch) {
  TRY(outcome, simulate::run(preset, true, watch));
  return std::move(outcome->trajectory);
}

/// The designed shell as a run of its own.
Result<record::Trajectory> run_designed(const preset::Preset& preset, const fs::path& folder,
                                        record::Summary& summary, Watch& watch) {
  record::FolderSink sink(folder, {preset.name, record::Kind::figure, preset.title});
  TRY(run, simulate::run(preset, true, sink, watch));
  summary = *run;
  summary.kind = record::Kind::figure;
  return sink.finish(summary);
}

/// Whether the patient way from the flat ends in the same state.
FlatStartCheck from_flat(preset::Preset preset, const record::Trajectory& designed, Watch& watch) {
  preset.actuation.start = preset::Start::flat;
  const auto outcome = simulate::run(preset, true, watch);
  FlatStartCheck found;
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
  TRY(found, design(preset, progress.next_phase()));
  preset::Preset designed = preset;
  designed.ends.table = found->table;
  if (found->largest_thickening > 0) designed.rod_table = found->rod_table;
  TRY(before, end_of(preset, progress.next_phase()));
  TRY(after, run_designed(designed, folder, summary, progress.next_phase()));
  Watch& last = progress.next_phase();
  const FlatStartCheck flat = from_flat(designed, *after, last);
  if (last.cancelled()) return stopped();
  text = design_text(*found, flat);
  return write_design(folder, designed, *found, flat).and_then([&] {
    auto artist = PictureMaker::create(options.context, preset.style.font);
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
  const auto fault = failure_of(summary, preset->allow_unstable);
  if (!fault.empty()) std::fprintf(stderr, "%s: %s\n", preset->name.c_str(), fault.c_str());
  return fault.empty() ? ExitCode::done : ExitCode::failed;
}

// `gridshell design PRESET`: what is moved so that a shell meets its surface.

void add_design(CLI::App& program, Action& action) {
  const auto options = std::make_shared<Options>();
  auto* command = program.add_subcommand(
      "design", "moves pins, legs, held directions or diameters until the shell meets its surface");
  add_preset_options(*command, *options);
  add_work_options(*command, *options, "folder to write, by default out/<preset>_design");
  add_picture_options(*command, *options);
  command->callback(
      [&action, options] { action = [options] { return produce_design(*options); }; });
}

}  // namespace gridshell::app
