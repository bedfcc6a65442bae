#include "app/cli/figures.h"

#include <fmt/format.h>
#include <algorithm>
#include <cstdio>
#include <utility>

#include "app/cli/console.h"
#include "app/cli/paper_page.h"
#include "app/cli/preset_library.h"
#include "engine/core/file_io.h"
#include "engine/core/try.h"
#include "render/gl/image.h"
#include "render/movie/movie_writer.h"
#include "render/movie/run_figures.h"
#include "render/movie/run_plots.h"
#include "render/movie/run_summary.h"
#include "render/movie/stage.h"
#include "render/movie/stills.h"

namespace gridshell::app {
namespace fs = std::filesystem;
namespace {

/// Whether `gridshell design` can design this preset and has not done so yet.
bool to_be_designed(const preset::Preset& preset) {
  return !preset.inverse.vary.empty() && preset.ends.table.empty() && preset.rod_table.empty();
}

std::string name_of(const preset::Preset& preset) {
  if (preset.footprint.kind == preset::FootprintKind::blocks) return "assembled shell";
  const preset::Net& net = preset.net;
  using preset::NetKind;
  if (net.kind == NetKind::sphere)
    return to_be_designed(preset) ? "before the design"
           : net.cut_height == 0  ? "hemisphere"
                                  : fmt::format("*z*^{{*}}/*ρ* = {:g}", net.cut_height);
  if (net.kind == NetKind::profile) return "surface of revolution";
  if (net.kind == NetKind::translation) return "translation net";
  if (net.kind == NetKind::spool || net.kind == NetKind::beltrami) return "saddle";
  return std::string(word_of(net.kind));
}

fs::path with_suffix(fs::path stem, const char* suffix) { return stem += suffix; }

/// Draws one assemblage: its blocks separately, their footprints, and how they meet.
Result<void> draw_block_pictures(const record::Trajectory& run, const render::MovieStyle& style,
                                 const fs::path& stem, Watch& watch) {
  TRY_DO(save_panels(render::draw_blocks({{&run, ""}}, style, watch),
                     with_suffix(stem, "_blocks.png"), style.print.dpi));
  TRY_DO(render::write_block_footprints(with_suffix(stem, "_footprint"), run, style.title,
                                        style.print));
  if (run.layout.seam_rods.empty()) return {};
  return render::write_plots(with_suffix(stem, "_seams"), render::seam_plots(run), style.title,
                             "Seams of the blocks", style.print);
}

/// Name and largest deviation of the joints, "hemisphere: max 3.1 %". That of the rods follows if
/// it is more than 1.2 times as large, since the colours show it. `narrow`: on two lines.
std::string caption_of(const record::Trajectory& run, const std::string& name, bool narrow) {
  constexpr double further = 1.2;
  const Eigen::VectorXd deviation = render::last_deviation(run);
  const render::DeviationUnit unit = render::deviation_unit(run.layout);
  const double joints = unit.factor * deviation.head(long(run.layout.joints.size())).maxCoeff(),
               rods = unit.factor * deviation.maxCoeff();
  const char* word = run.layout.parts.empty() ? "%" : "mm";
  const std::string first = name + (narrow ? "\n" : ": ");
  const auto text = [](double value) { return fmt::format("{:.{}f}", value, value < 1 ? 2 : 1); };
  if (rods <= further * joints) return fmt::format("{}max {} {}", first, text(joints), word);
  return fmt::format("{}max {} {},{}rods {} {}", first, text(joints), word, narrow ? "\n" : " ",
                     text(rods), word);
}

/// The name of a run in a picture of several runs, text without markup: its own title, or the name
/// of its case if it has the common title.
std::string title_among(const Run& run, const std::string& of_all) {
  return run.preset.title == of_all && !run.name.empty() ? run.name : run.preset.title;
}
/// The title of a picture of one run: the common title and its own.
std::string title_alone(const Run& run, const std::string& of_all) {
  const std::string title = title_among(run, of_all);
  return of_all.empty() || title == run.preset.title ? title : of_all + ": " + title;
}

bool is_still(const Run& run) { return run.pictures == Pictures::stills; }
/// Whether the run is shown in one movie together with the other cases.
bool drawn_side_by_side(const Run& run) {
  return run.pictures == Pictures::movie && run.preset.movie.beside && !run.name.empty();
}
/// Whether the shell is drawn over its net; not if it is pushed, searched for states or has steps.
bool shows_net(const Run& run) {
  const preset::Preset& preset = run.preset;
  return is_still(run) && preset.on_net() && !preset.indentation.requested() &&
         !preset.jitter.requested() && preset.step.empty();
}
bool shows_push(const Run& run) { return is_still(run) && run.preset.indentation.requested(); }
/// Whether draw_cases() shows the run next to the other cases: no other picture does.
bool shows_case(const Run& run) {
  return is_still(run) && !run.name.empty() && !shows_net(run) && !shows_push(run) &&
         !run.preset.jitter.requested();
}
bool has_net(const Run& run) {
  return shows_net(run) && run.trajectory.layout.net_nodes.size() > 0;
}

/// Writes folder/frames/frame_00000.png ... and, if ffmpeg is on the PATH, folder/movie.mp4.
Result<void> draw_side_by_side(const Runs& runs, const std::string& title,
                               render::Renderer& renderer, const fs::path& folder, Watch& watch) {
  auto style = style_of(runs.front()->preset, Pictures::movie);
  style.title = title;
  std::vector<render::NamedRun> compared;
  std::size_t frames = 0;
  for (const Run* run : runs) {
    compared.push_back({&run->trajectory, title_among(*run, title)});
    frames = std::max(frames, run->trajectory.frames.size());
  }
  return make_movie(folder, runs.front()->preset, style, int(frames), watch,
                    [&](const render::FrameCallback& seen) {
                      return render::write_side_by_side(compared, style, renderer,
                                                        folder / "frames", watch, seen);
                    });
}

/// Writes `<stem>_loads.png` and, each as PNG and SVG, `<stem>_force` and `<stem>_bins`.
Result<void> draw_push_pictures(const Runs& runs, const std::string& title, const fs::path& stem,
                                Watch& watch) {
  auto style = style_of(runs.front()->preset, Pictures::stills);
  // with several runs the figure has the title of the preset, and each shell its own
  const bool several = runs.size() > 1;
  const std::string above = runs.front()->preset.figure.title ? title : "";
  if (several) style.title = above;
  std::vector<render::NamedRun> shells;
  for (const Run* run : runs)
    shells.push_back({&run->trajectory, render::plain(title_among(*run, title))});
  render::Plot force = render::force_plot(shells);
  force.title = render::plain(style.title);
  TRY_DO(save_panels(render::draw_pushes(shells, style, watch), with_suffix(stem, "_loads.png"),
                     style.print.dpi));
  TRY_DO(render::write_plot(with_suffix(stem, "_force"), force, style.print));
  // a single run has its title above its plot
  return render::write_push_bins(with_suffix(stem, "_bins"), shells, several ? above : "",
                                 style.print);
}

/// Writes `<stem>.png`: the last states of the cases side by side.
Result<void> draw_cases(const Runs& runs, const std::string& title, const SharedColourBar& bar,
                        render::Renderer& renderer, const fs::path& stem, Watch& watch) {
  auto style = render::still_style(style_of(runs.front()->preset, Pictures::stills));
  style.title = runs.front()->preset.figure.title ? title : "";
  style.heading = style.legends = style.look.floor = false;
  render::PanelFigure figure = render::empty_figure(style, 3);
  figure.colour_bar = bar;
  for (const Run* run : runs) {
    const record::Trajectory& shown = run->trajectory;
    TRY_DO(render::check_showable(shown, style));
    const render::Stage stage(shown.layout, render::summarise_run(shown), style, bar);
    const record::Frame last = shown.frames.back();
    const std::string caption =
        render::plain(title_among(*run, title)) + "\n" + render::frame_state_caption(last);
    TRY_DO(
        render::add_panel(figure, stage, stage.drawing(last), {true, caption}, &renderer, watch));
  }
  return save_panels(figure, with_suffix(stem, ".png"),
                     style.print.width_mm > 0 ? style.print.dpi : 0);
}

/// Draws every picture that shows several runs; `bar`: the colour bar of the first one.
Result<void> draw_together(const std::vector<Run>& runs, const std::string& title,
                           const SharedColourBar& bar, render::Renderer& renderer,
                           const fs::path& stem, Progress& progress) {
  const auto those = [&](bool (*requested)(const Run&)) {
    Runs found;
    for (const Run& run : runs)
      if (requested(run)) found.push_back(&run);
    return found;
  };
  if (const Runs side_by_side = those(drawn_side_by_side); !side_by_side.empty())
    return draw_side_by_side(side_by_side, title, renderer, stem.parent_path(),
                             progress.next_phase());
  const Runs stills = those(is_still);
  if (stills.empty()) return {};
  if (stills.front()->preset.page.kind != preset::PageKind::none)
    return draw_page(stills, renderer, stem, progress.next_phase());
  if (const Runs nets = those(has_net); !nets.empty())
    TRY_DO(draw_net_pictures(nets, stem, progress.next_phase()));
  if (const Runs pushes = those(shows_push); !pushes.empty())
    TRY_DO(draw_push_pictures(pushes, title, stem, progress.next_phase()));
  // they have one colour bar, so all must show the same quantity
  const bool alike = std::ranges::all_of(stills, [&](const Run* run) {
    return run->preset.movie.colour_by == stills.front()->preset.movie.colour_by;
  });
  if (const Runs cases = those(shows_case); cases.size() > 1 && alike)
    TRY_DO(draw_cases(cases, title, bar, renderer, stem, progress.next_phase()));
  return {};
}

}  // namespace

Result<void> save_panels(const Result<render::PanelFigure>& figure, const fs::path& file,
                         double dpi) {
  if (!figure) return tl::unexpected(figure.error());
  return render::write_panels(*figure, file, dpi);
}

Result<void> draw_net_pictures(const Runs& runs, const fs::path& stem, Watch& watch) {
  const auto style = style_of(runs.front()->preset, Pictures::stills);
  const record::Trajectory& first = runs.front()->trajectory;
  const bool alone = runs.size() == 1;
  std::vector<render::NamedRun> shells, shades;
  const auto named = [](const Run& run) {
    return run.label.empty() ? name_of(run.preset) : run.label;
  };
  for (const Run* run : runs) {
    std::string name = named(*run);
    // cases of one net have their own names
    if (std::ranges::count(runs, name, [&](const Run* one) { return named(*one); }) > 1)
      name = render::plain(run->name);
    shells.push_back({&run->trajectory, name, scan_of(run->preset)});
    shades.push_back({&run->trajectory, caption_of(run->trajectory, name, runs.size() > 2)});
  }
  const auto write = [&](const char* suffix, render::Plot plot) {
    plot.title = render::plain(style.title);
    return render::write_plot(with_suffix(stem, suffix), plot, style.print);
  };
  const double dpi = style.print.dpi;
  TRY_DO(save_panels(render::draw_over_nets(shells, style, watch), with_suffix(stem, "_net.png"),
                     dpi));
  TRY_DO(save_panels(render::draw_deviations(shades, style, watch),
                     with_suffix(stem, "_deviation.png"), dpi));
  if (alone && !first.layout.parts.empty())
    TRY_DO(draw_block_pictures(first, style, stem, watch));
  else
    TRY_DO(render::write_footprints(with_suffix(stem, "_footprint"), shells, style.title,
                                    style.print));
  TRY_DO(write("_K", render::curvature_plot(shells)));
  TRY_DO(write("_quantiles", render::quantile_plot(shells)));
  if (!alone || !render::on_sphere(first.layout)) return {};
  return write("_latitude", render::latitude_plot(shells.front()));
}

std::vector<Phase> drawing_phases(const std::vector<Run>& runs) {
  std::vector<Phase> phases;
  double seconds = 0;
  for (const Run& run : runs) {
    const double expected = expected_seconds(run.pictures, run.preset);
    seconds += expected;
    if (run.pictures != Pictures::none && !drawn_side_by_side(run))
      phases.push_back(drawing("drawing" + (run.name.empty() ? "" : " " + run.name), expected));
  }
  const auto any = [&](auto requested) { return std::ranges::any_of(runs, requested); };
  if (any(drawn_side_by_side)) {
    phases.push_back(drawing("drawing", seconds));
  } else if (any(is_still) && runs.front().preset.page.kind != preset::PageKind::none) {
    phases.push_back(drawing("drawing the page", seconds));
  } else {
    if (any(shows_net)) phases.push_back(drawing("drawing shells over nets", seconds));
    if (any(shows_push)) phases.push_back(drawing("drawing point loads", seconds));
    if (std::ranges::count_if(runs, shows_case) > 1)
      phases.push_back(drawing("drawing cases", 0.2 * seconds));
  }
  return phases;
}

Result<void> draw_all(std::vector<Run>& runs, const std::string& title, const fs::path& stem,
                      render::Renderer& renderer, const fs::path& folder, Progress& progress) {
  const bool all_side_by_side = std::ranges::all_of(runs, drawn_side_by_side);
  const auto bars =
      all_side_by_side ? std::vector<SharedColourBar>(runs.size()) : shared_bars(runs);
  for (std::size_t k = 0; k < runs.size(); ++k) {
    Run& run = runs[k];
    const fs::path to = folder_of(folder, run.name);
    TRY_DO(make_folder(to));
    if (drawn_side_by_side(run)) continue;
    const double start = seconds_now();
    Watch& watch = progress.next_phase();
    const std::string own = std::exchange(run.preset.title, title_alone(run, title));
    if (run.preset.jitter.requested())
      TRY_DO(draw_states(run, renderer, to / fs::path(run.preset.name).filename(), watch));
    else
      TRY_DO(draw_run(run, bars[k], renderer, to, watch));
    run.preset.title = own;
    run.summary.seconds_render += seconds_now() - start;
  }
  const double start = seconds_now();
  TRY_DO(draw_together(runs, title, bars.front(), renderer, folder / stem, progress));
  for (Run& run : runs) run.summary.seconds_render += (seconds_now() - start) / double(runs.size());
  return {};
}

Result<std::string> draw_net_plan(const preset::Case& run, const Scene& scene,
                                  const fs::path& folder) {
  using render::PlanPart;
  const MeshNetReport& net = *scene.mesh_net;
  TRY(rods, rods_on_net(scene, run.preset.footprint.spacing_mm / 8));
  std::vector<PlanPart> parts;
  for (const auto& [why, fraction] : net.reasons()) {
    PlanPart& part = parts.emplace_back(PlanPart{PlanPart::Kind::left_out, {}});
    part.name = fmt::format("left out, {:.1f} %: {}", 100 * fraction, text_of(why));
    part.points.resize(3, std::ranges::count(net.left_out, why, &AreaSample::why));
    Eigen::Index count = 0;
    for (const AreaSample& one : net.left_out)
      if (one.why == why) part.points.col(count++) = one.at;
  }
  parts.push_back({PlanPart::Kind::rods,
                   fmt::format("the net, {:.1f} % of the area", 100 * net.start.reached),
                   std::move(*rods)});
  for (const auto& [kind, line, name] : {std::tuple(PlanPart::Kind::rim, LineKind::rim, ""),
                                         {PlanPart::Kind::hole, LineKind::hole, "holes"},
                                         {PlanPart::Kind::crease, LineKind::crease, "creases"}}) {
    PlanPart part{kind, name};
    for (const auto& one : net.drawn)
      if (one.kind == line) part.lines.push_back(one.points);
    parts.push_back(std::move(part));
  }
  parts.push_back({PlanPart::Kind::apex, "the apex", {}, net.start.pose.apex});
  fs::path stem = folder;
  stem += (run.name.empty() ? "" : "_" + run.name) + "_plan";
  if (stem.has_parent_path()) TRY_DO(make_folder(stem.parent_path()));
  const auto style = style_of(run.preset, Pictures::stills);
  TRY_DO(render::write_plot(stem, render::net_plan(parts, render::plain(run.preset.title)),
                            style.print, 1.1));
  return stem.string() + ".png";
}

void draw_refusals(const preset::Presets& presets, const fs::path& folder) {
  for (const auto& run : runs_of(presets)) {
    const auto net = refused_net(run.preset);
    if (!net) continue;
    fs::path stem = folder;
    stem += (run.name.empty() ? "" : "_" + run.name) + "_refused";
    const auto style = style_of(run.preset, Pictures::stills);
    std::error_code unmade;  // reported by what writes
    if (stem.has_parent_path()) fs::create_directories(stem.parent_path(), unmade);
    const auto drawn = render::write_plot(
        stem,
        render::refused_plot(net->lines, net->narrow, net->end, render::plain(run.preset.title)),
        style.print, 1.1);
    if (drawn)
      std::fprintf(stderr, "where the net ends: %s.png\n", stem.string().c_str());
    else
      report(drawn.error());
  }
}

}  // namespace gridshell::app
