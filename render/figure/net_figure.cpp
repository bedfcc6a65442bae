#include "render/figure/net_figure.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "engine/record/net_deviation.h"
#include "render/figure/block_figure.h"
#include "render/figure/vector_shell.h"
#include "render/movie/stage.h"
#include "render/plot/panels.h"

namespace gridshell::render {
namespace {

constexpr Colour shell_ink{0.10f, 0.10f, 0.12f, 1}, net_ink{0.16f, 0.42f, 0.78f, 1},
    scan_ink{0.80f, 0.16f, 0.12f, 1};

/// The last frame alone, its boundary where it is held.
record::Trajectory final_state(const record::Trajectory& run) {
  record::Trajectory last;
  last.layout = run.layout;
  last.layout.original_boundary = run.layout.actuated_boundary;
  last.frames = {run.frames.back()};
  return last;
}

MovieStyle plain_style(MovieStyle style) {
  style.captions = style.inset = false;
  style.turn_deg = 0;
  style.colour_by = ColourBy::none;
  return style;
}

using Dress = std::function<void(const NetRun&, Drawing&)>;

/// One panel a run, the drawing of each changed by `dress`.
Result<PanelFigure> panels_of(const std::vector<NetRun>& runs, const MovieStyle& movie_style,
                              Renderer& renderer, Watch& watch, int columns, const Dress& dress) {
  const MovieStyle style = plain_style(movie_style);
  PanelFigure figure;
  if (style.print.width_mm > 0) figure.print = style.print;
  figure.title = style.title;
  figure.columns = std::min(columns, int(runs.size()));
  for (std::size_t k = 0; k < runs.size(); ++k) {
    if (watch.cancelled()) return fail(Fault::cancelled, "stopped while drawing a figure");
    if (auto showable = check_showable(*runs[k].run, style); !showable)
      return tl::unexpected(showable.error());
    const record::Trajectory last = final_state(*runs[k].run);
    const Stage stage(last, style);
    Drawing drawing = stage.drawing(last.frames.front());
    drawing.ground = false;
    dress(runs[k], drawing);
    auto picture =
        renderer.draw(drawing, stage.camera(0), draw_quality(style), style.width, style.height);
    if (!picture) return tl::unexpected(picture.error());
    const std::string letter =
        runs.size() > 1 && style.look.letters ? std::string(1, char('a' + k % 26)) : "";
    figure.panels.push_back({std::move(*picture), letter, runs[k].caption});
    if (style.vector) figure.panels.back().lines = shell_lines(std::move(drawing), stage.camera(0));
    if (runs.size() == 1) {
      figure.scale_bar_mm = style.scale_bar_mm;
      figure.pixels_per_mm = stage.pixels_per_mm();
    }
  }
  return figure;
}

/// A round end above `largest`, so that a bar's last label is the scale's end.
double round_end(double largest) {
  const double power = std::pow(10.0, std::floor(std::log10(std::max(largest, 1e-9))));
  for (const double leading : {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0})
    if (largest <= leading * power) return leading * power;
  return 10 * power;
}

/// What the colours over nets stand for.
std::vector<ColourKey> over_net_keys(const std::vector<NetRun>& runs) {
  std::vector<ColourKey> keys{{shell_ink, "shell at rest"}};
  const record::Layout& layout = runs.front().run->layout;
  if (layout.parts.empty() && layout.net_nodes.cols() > 0) keys.push_back({net_ink, "its net"});
  for (ColourKey key : block_keys(layout)) {
    key.name.insert(0, "net of ");
    keys.push_back(std::move(key));
  }
  if (std::any_of(runs.begin(), runs.end(), [](const NetRun& one) { return one.scanned.size(); }))
    keys.push_back(scan_key());
  return keys;
}

}  // namespace

Eigen::VectorXd last_deviation(const record::Trajectory& run) {
  return record::deviation_of_nodes(run.layout, run.frames.back());
}

bool on_sphere(const record::Layout& layout) {
  if (layout.net_nodes.size() == 0) return false;
  const auto radius = layout.net_nodes.colwise().norm().array();
  return (radius - layout.length_scale_mm).abs().maxCoeff() < 1e-6 * layout.length_scale_mm;
}

void dress_for_scan(const Eigen::Matrix3Xd& measured, Drawing& drawing) {
  for (const auto& joint : measured.colwise())
    drawing.marks.push_back({joint, std::max(3.0, 3 * drawing.rod_diameter_mm), scan_ink});
  drawing.rod_colour = shell_ink;
  drawing.joint_diameter_mm = 0;
}

ColourKey scan_key() { return {scan_ink, "joints measured"}; }

Result<PanelFigure> draw_over_nets(const std::vector<NetRun>& runs, const MovieStyle& style,
                                   Renderer& renderer, Watch& watch, int columns) {
  const auto dress = [](const NetRun& one, Drawing& drawing) {
    dress_for_scan(one.scanned, drawing);
    const record::Layout& layout = one.run->layout;
    // blocks each on a net of its own
    for (std::size_t k = 0; k < layout.parts.size(); ++k)
      drawing.ghosts.push_back(
          {layout.parts[k].net, layout.parts[k].rods, drawing.rod_diameter_mm, block_colour(k)});
    if (layout.parts.empty() && layout.net_nodes.cols() > 0)
      drawing.ghosts.push_back({layout.net_nodes, layout.rods, drawing.rod_diameter_mm, net_ink});
  };
  return panels_of(runs, style, renderer, watch, columns, dress).map([&](PanelFigure figure) {
    figure.keys = over_net_keys(runs);
    return figure;
  });
}

DeviationUnit deviation_unit(const record::Layout& layout) {
  // blocks have no radius that is theirs alone
  if (!layout.parts.empty()) return {layout.length_scale_mm, "Δ (mm)"};
  return {100, "Δ/*ρ* (%)"};
}

Result<PanelFigure> draw_deviations(const std::vector<NetRun>& runs, const MovieStyle& style,
                                    Renderer& renderer, Watch& watch, int columns) {
  double largest = 0;
  const DeviationUnit unit = deviation_unit(runs.front().run->layout);
  for (const NetRun& one : runs)
    largest = std::max(largest, unit.factor * last_deviation(*one.run).maxCoeff());
  const ColourScale scale{ColourMap::sequential, 0, round_end(largest), 0.2};
  const auto dress = [&](const NetRun& one, Drawing& drawing) {
    const Eigen::VectorXd deviation = last_deviation(*one.run);
    for (double share : deviation) drawing.node_colours.push_back(scale(unit.factor * share));
    drawing.rod_diameter_mm *= 1.8;
    drawing.sheen = 0.2;
    drawing.joint_diameter_mm = 0;
  };
  auto figure = panels_of(runs, style, renderer, watch, columns, dress);
  if (!figure) return tl::unexpected(figure.error());
  figure->colour_bar = ColourBar{unit.label, scale};
  figure->colour_bar->words = "distance from the net";
  return figure;
}

}  // namespace gridshell::render
