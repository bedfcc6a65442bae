#include "render/movie/run_figures.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "engine/core/try.h"
#include "engine/record/frame_values.h"
#include "render/canvas/text.h"
#include "render/movie/frame_overlay.h"
#include "render/movie/run_summary.h"

namespace gridshell::render {
namespace {

constexpr Colour shell_ink = ink, scan_ink{0.80f, 0.16f, 0.12f, 1};

/// A caption with the interpenetrations of a frame in a row of its own, which explains their marks.
std::string with_contacts(const std::string& caption, const record::Frame& frame) {
  const std::string contacts = contact_caption(frame);
  if (contacts.empty()) return caption;
  return caption + (caption.empty() ? "" : "\n") + "violet: " + contacts;
}

/// Adds the axis x, of length L from the middle of a shell to its boundary, in front of the shell.
void add_half_span(const record::Layout& layout, Drawing& drawing) {
  const Eigen::Vector3d low = layout.actuated_boundary.rowwise().minCoeff(),
                        high = layout.actuated_boundary.rowwise().maxCoeff();
  const double off = 0.12 * layout.length_scale_mm, middle = 0.5 * (low.x() + high.x());
  const Eigen::Vector3d from(middle, low.y() - off, low.z()), to(high.x(), from.y(), low.z());
  drawing.arrows.push_back({from, to, 1.2 * drawing.rod_diameter_mm, shell_ink});
  drawing.labels.push_back({to + Eigen::Vector3d(2 * off, 0, 0), "*x* = *L*"});
}

using DrawingEdit = std::function<void(const NamedRun&, Drawing&)>;

/// Sets the scale of all panels to that of the largest shell, and its scale bar.
void show_scale_of(const std::vector<Stage>& stages, PanelFigure& figure) {
  figure.pixels_per_mm = stages.front().pixels_per_mm();
  for (const Stage& stage : stages)
    figure.pixels_per_mm = std::min(figure.pixels_per_mm, stage.pixels_per_mm());
  figure.scale_bar_mm = stages.front().style().scale_bar_mm;
}

/// A figure with one panel per run, whose drawing is changed by `edit`.
Result<PanelFigure> panels_of(const std::vector<NamedRun>& runs, const MovieStyle& movie_style,
                              Watch& watch, int columns, const DrawingEdit& edit) {
  MovieStyle style = uncoloured(movie_style);
  PanelFigure figure = empty_figure(style, std::min(columns, int(runs.size())));
  std::vector<record::Trajectory> states;
  for (const NamedRun& one : runs) {
    TRY_DO(check_showable(*one.run, style));
    states.push_back(states_alone(*one.run, {one.run->frames.size() - 1}, style));
  }
  std::vector<Stage> stages;
  for (const record::Trajectory& state : states) stages.emplace_back(state, style);
  show_scale_of(stages, figure);
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const double wider = stages[k].pixels_per_mm() / figure.pixels_per_mm;
    Drawing drawing = stages[k].drawing(states[k].frames.front());
    drawing.ground = false;
    // lines as thick on paper as those of the largest shell
    drawing.rod_diameter_mm *= wider;
    edit(runs[k], drawing);
    TRY_DO(
        add_panel(figure, stages[k], std::move(drawing),
                  {runs.size() > 1, with_contacts(runs[k].name, states[k].frames.front()), wider},
                  nullptr, watch));
  }
  return figure;
}

std::vector<ColourKey> over_net_keys(const std::vector<NamedRun>& runs) {
  std::vector<ColourKey> keys{{shell_ink, "equilibrium"}};
  const record::Layout& layout = runs.front().run->layout;
  if (layout.parts.empty() && layout.net_nodes.cols() > 0)
    keys.push_back({net_ink, "Chebyshev net"});
  for (ColourKey key : BlockKinds(runs).keys()) {
    key.name.insert(0, "net of ");
    keys.push_back(std::move(key));
  }
  if (std::ranges::any_of(runs, [](const NamedRun& one) { return one.scanned.size(); }))
    keys.push_back(scan_key());
  return keys;
}

MovieStyle panel_style(MovieStyle style) {
  style.captions = style.inset = style.bins = style.legends = false;
  style.turn_deg = 0;
  style.colour_by = ColourBy::displacement;
  style.look.floor = false;
  style.look.joint_mm = 0;
  // square panels, for round shells
  style.size[0] = style.size[1];
  return style;
}

}  // namespace

MovieStyle uncoloured(MovieStyle style) {
  style.captions = style.inset = false;
  style.turn_deg = 0;
  style.colour_by = ColourBy::none;
  return style;
}

PanelFigure empty_figure(const MovieStyle& style, int columns) {
  PanelFigure figure{.title = style.title, .panels = {}, .columns = columns, .colour_bar = {}};
  if (style.print.width_mm > 0) figure.print = style.print;
  figure.background = style.look.background;
  return figure;
}

std::string panel_letter(const MovieStyle& style, std::size_t k) {
  return style.look.letters ? std::string(1, char('A' + k % 26)) : "";
}

Result<void> add_panel(PanelFigure& figure, const Stage& stage, Drawing drawing,
                       const PanelText& text, Renderer* renderer, const Watch& watch) {
  if (watch.cancelled()) return fail(Fault::cancelled, "stopped while drawing a figure");
  const MovieStyle& style = stage.style();
  Camera camera = stage.camera(stage.frames() - 1);
  camera.half_extent_mm *= text.wider;
  Panel& panel =
      figure.panels.emplace_back(Panel{Image(style.width(), style.height()), "", text.caption});
  for (const PointLabel& label : drawing.labels) {
    const Eigen::Vector2d at = to_pixel(camera, style.width(), style.height(), label.at);
    panel.labels.push_back(
        {{at.x() / style.width(), at.y() / style.height()}, label.text, label.bold});
  }
  if (text.lettered) panel.letter = panel_letter(style, figure.panels.size() - 1);
  if (renderer) {
    TRY(picture,
        renderer->draw(drawing, camera, draw_quality(style), style.width(), style.height()));
    panel.picture = std::move(*picture);
  }
  figure.as_lines = renderer == nullptr;
  if (style.vector || !renderer) panel.lines = shell_lines(std::move(drawing), camera);
  return {};
}

record::Trajectory states_alone(const record::Trajectory& run,
                                const std::vector<std::size_t>& which, MovieStyle& style) {
  style.look.ghost = false;
  record::Trajectory few;
  few.layout = run.layout;
  few.layout.original_boundary = run.layout.actuated_boundary;
  for (const std::size_t k : which) few.frames.push_back(run.frames[k]);
  return few;
}

Eigen::VectorXd last_deviation(const record::Trajectory& run) {
  return record::deviation_of_nodes(run.layout, run.frames.back());
}

bool on_sphere(const record::Layout& layout) {
  if (layout.net_nodes.size() == 0) return false;
  const auto radius = layout.net_nodes.colwise().norm().array();
  return (radius - layout.length_scale_mm).abs().maxCoeff() < 1e-6 * layout.length_scale_mm;
}

void show_measured_joints(const Eigen::Matrix3Xd& measured, Drawing& drawing) {
  for (const auto& joint : measured.colwise())
    drawing.marks.push_back({joint, std::max(3.0, 3 * drawing.rod_diameter_mm), scan_ink});
  drawing.rod_colour = shell_ink;
  drawing.joint_diameter_mm = 0;
}

ColourKey scan_key() { return {scan_ink, "joints measured"}; }

Result<PanelFigure> draw_over_nets(const std::vector<NamedRun>& runs, const MovieStyle& style,
                                   Watch& watch, int columns) {
  const auto dress = [kinds = BlockKinds(runs)](const NamedRun& one, Drawing& drawing) {
    show_measured_joints(one.scanned, drawing);
    const record::Layout& layout = one.run->layout;
    // the net is wider and below, so that it is visible on both sides of rods that are on it
    drawing.rod_diameter_mm *= 1.5;
    const double wide = 2.6 * drawing.rod_diameter_mm;
    // every block has a net of its own
    for (const record::Part& part : layout.parts)
      drawing.ghosts.push_back({part.net, part.rods, wide, kinds.colour(part.name)});
    if (layout.parts.empty() && layout.net_nodes.cols() > 0)
      drawing.ghosts.push_back({layout.net_nodes, layout.rods, wide, net_ink});
    if (one.half_span) add_half_span(layout, drawing);
  };
  return panels_of(runs, style, watch, columns, dress).map([&](PanelFigure figure) {
    figure.keys = over_net_keys(runs);
    return figure;
  });
}

DeviationUnit deviation_unit(const record::Layout& layout) {
  // building blocks have no common radius rho
  if (!layout.parts.empty()) return {layout.length_scale_mm, "Δ (mm)"};
  return {100, "Δ/*ρ* (%)"};
}

Result<PanelFigure> draw_deviations(const std::vector<NamedRun>& runs, const MovieStyle& style,
                                    Watch& watch, int columns) {
  double largest = 0;
  const DeviationUnit unit = deviation_unit(runs.front().run->layout);
  for (const NamedRun& one : runs)
    largest = std::max(largest, unit.factor * last_deviation(*one.run).maxCoeff());
  // a round end has the last label of the colour bar
  const ColourScale scale{sequential, 0, nice_ceiling(std::max(largest, 1e-9)), 0.2};
  const auto dress = [&](const NamedRun& one, Drawing& drawing) {
    const Eigen::VectorXd deviation = last_deviation(*one.run);
    for (double fraction : deviation) drawing.node_colours.push_back(scale(unit.factor * fraction));
    drawing.rod_diameter_mm *= 1.8;
    drawing.joint_diameter_mm = 0;
  };
  TRY(figure, panels_of(runs, style, watch, columns, dress));
  figure->colour_bar = ColourBar{unit.label, scale};
  figure->colour_bar->words = "deviation from the net";
  return figure;
}

Result<PanelFigure> draw_pushes(const std::vector<NamedRun>& runs, const MovieStyle& movie_style,
                                Watch& watch) {
  const MovieStyle style = panel_style(movie_style);
  std::vector<RunSummary> surveys;
  std::vector<const RunSummary*> all;
  for (const NamedRun& one : runs) surveys.push_back(summarise_run(*one.run));
  for (const RunSummary& survey : surveys) all.push_back(&survey);
  const auto bar = colour_bar_of(all, style);
  PanelFigure figure = empty_figure(style, std::min(3, int(runs.size())));
  figure.colour_bar = bar;
  // a single shell is named by the title
  const bool several = runs.size() > 1 || style.title.empty();
  std::vector<Stage> stages;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    TRY_DO(check_showable(*runs[k].run, style));
    stages.emplace_back(runs[k].run->layout, std::move(surveys[k]), style, bar);
  }
  show_scale_of(stages, figure);
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const record::Frame& last = runs[k].run->frames.back();
    Drawing drawing = stages[k].drawing(last);
    if (const auto ghost = stages[k].ghost_key(last)) figure.keys = {*ghost};
    const double wider = stages[k].pixels_per_mm() / figure.pixels_per_mm;
    // wider rods, since their colours are the result
    drawing.rod_diameter_mm *= 1.5 * wider;
    const std::string depth = state_captions(last).front(),
                      caption = several ? runs[k].name + "\n" + depth : depth;
    TRY_DO(add_panel(figure, stages[k], std::move(drawing),
                     {several, with_contacts(caption, last), wider}, nullptr, watch));
    watch.report(double(k + 1) / double(runs.size()));
  }
  return figure;
}

Result<void> write_push_bins(const std::filesystem::path& stem, const std::vector<NamedRun>& runs,
                             const std::string& title, const Print& print) {
  std::vector<Plot> plots;
  double low = 0, high = 0;
  for (const NamedRun& one : runs) {
    const record::Frame& last = one.run->frames.back();
    if (last.K_bins.rows() == 0) return {};
    plots.push_back(
        bins_plot(summarise_run(*one.run), long(one.run->layout.cells.size()), last, {}, 7.5));
    plots.back().title = one.name + "\n" + plots.back().title;
    low = std::min(low, plots.back().y.low.value_or(0));
    high = std::max(high, plots.back().y.high.value_or(0));
  }
  for (Plot& plot : plots) {
    plot.y.low = low;
    plot.y.high = high;
  }
  return write_plots(stem, std::move(plots), title, "K□ of the cells in bins of x/L", print);
}

Result<void> write_plots(const std::filesystem::path& stem, std::vector<Plot> plots,
                         const std::string& title, const std::string& name, const Print& print) {
  constexpr double font = 7.5, usual = 186, least = 150, height = 172;  // points
  // as many per row as are readable
  const double width = print.width_pt(usual * double(plots.size()));
  const std::size_t columns = std::clamp<std::size_t>(std::size_t(width / least), 1, plots.size());
  const std::size_t rows = (plots.size() + columns - 1) / columns;
  const double column = width / double(columns), head = title.empty() ? 0 : figure_title_room;
  for (Plot& plot : plots) plot.font_size = font;
  const Plot legend = plots.front();
  const double key = legend_height(legend, width - 18) + 6;
  // several plots have one legend above all of them
  const bool common = plots.size() > 1;
  for (Plot& plot : plots)
    if (common) plot.legend = LegendPosition::none;
  return write_figure(
      stem, width, head + key + height * double(rows), name,
      [&](Canvas& canvas) {
        if (head > 0) draw_figure_title(canvas, title);
        if (common) draw_legend(canvas, {9, head + 2, width - 18, key}, legend);
        for (std::size_t k = 0; k < plots.size(); ++k) {
          const std::size_t row = k / columns;
          const double x = column * double(k % columns),
                       y = head + (common ? key : 0) + height * double(row);
          draw_plot(canvas, {x + 3, y + 3, column - 6, (common ? height : height + key) - 6},
                    plots[k]);
        }
      },
      print);
}

}  // namespace gridshell::render
