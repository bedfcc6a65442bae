#include <fmt/format.h>
#include <algorithm>
#include <optional>

#include "app/cli/figures.h"
#include "app/cli/paper_page.h"
#include "app/cli/pictures.h"
#include "app/cli/sweep_folder.h"
#include "engine/core/try.h"
#include "engine/gridshell.h"
#include "render/canvas/legend.h"
#include "render/movie/run_figures.h"
#include "render/movie/run_summary.h"
#include "render/movie/stage.h"
#include "render/movie/state_charts.h"

namespace gridshell::app {
namespace {

using record::StateClass;
using record::StateRow;
using render::Box;
using render::Canvas;

// positions on the page, mm
constexpr double page_width = 178, page_height = 147, margin = 2;
constexpr Box above{margin, margin, 160, 38}, diagram{margin, 42, 97, 94}, maps{101, 42, 75, 94},
    foot{margin, 137, 97, 5};
constexpr double points_per_mm = 72 / 25.4, caption = 12;  // height of a caption, points

/// A state of a run.
struct Found {
  const Run* record = nullptr;
  std::size_t at = 0;

  const record::StateRow& row() const { return record->states.rows[at]; }
  const record::Frame& frame() const { return record->trajectory.frames[at]; }
};

/// "state *ii* (*C*_{2v})": class and symmetry group, as the page has one state of each class.
std::string page_name_of(const StateRow& row) {
  return fmt::format("{} ({})", class_text(row.kind), group_text(row.group));
}

/// The state of a class that has the lowest energy.
std::optional<Found> lowest_of(StateClass kind, const Run& record) {
  std::optional<Found> lowest;
  for (std::size_t k = 0; k < record.states.rows.size(); ++k) {
    const Found one{&record, k};
    if (one.row().kind == kind && (!lowest || one.row().energy_mJ() < lowest->row().energy_mJ()))
      lowest = one;
  }
  return lowest;
}

/// The state of lowest energy of a class in the first run that has one; energies of different
/// footprints are not compared.
std::optional<Found> lowest_of(StateClass kind, const Runs& records) {
  std::optional<Found> lowest;
  for (const Run* record : records)
    if (!lowest) lowest = lowest_of(kind, *record);
  return lowest;
}

/// Longest leg and number of rods of a circle, "(*L̄*_{d}, *n*) = (0.8, 12)"; else empty.
std::string position_text(const preset::Preset& preset) {
  if (preset.footprint.kind != preset::FootprintKind::circle) return "";
  const double radius = preset.original_radius_mm() / preset.footprint.spacing_mm;
  return fmt::format("(*L̄*_{{d}}, *n*) = ({:.3g}, {})",
                     record::longest_leg(radius, preset.footprint.rods), preset.footprint.rods);
}

/// The index of the state with the smallest mean distance from the measured joints to its own; -1
/// if none were measured.
int state_measured(const Eigen::Matrix3Xd& measured, const record::Trajectory& states) {
  if (measured.cols() == 0) return -1;
  std::vector<double> away;
  for (const record::Frame& frame : states.frames) {
    const auto joints = frame.nodes.leftCols(Eigen::Index(states.layout.joints.size()));
    double sum = 0;
    for (const auto& joint : measured.colwise())
      sum += (joints.colwise() - joint).colwise().norm().minCoeff();
    away.push_back(sum);
  }
  return int(std::ranges::min_element(away) - away.begin());
}

/// Adds a picture of a state in space.
Result<void> add_state(Page& page, const Found& found, const render::Stage& stage,
                       render::Drawing drawing, const std::string& letter,
                       const std::string& caption, const Box& box, render::Renderer& renderer) {
  const render::MovieStyle& style = stage.style();
  const render::Camera camera = stage.camera(0);
  TRY(picture,
      renderer.draw(drawing, camera, render::draw_quality(style), style.width(), style.height()));
  render::Panel panel{std::move(*picture), letter, ""};
  if (style.vector) panel.lines = render::shell_lines(std::move(drawing), camera);
  page.add_panel(fmt::format("{}, {}", page_name_of(found.row()), caption), box, std::move(panel));
  return {};
}

/// The ratio of the radii of two shells.
double width_over(const record::Trajectory& run, const record::Trajectory& other) {
  const auto reach = [](const record::Trajectory& one) {
    return one.layout.actuated_boundary.topRows<2>().colwise().norm().maxCoeff();
  };
  return reach(run) / reach(other);
}

/// Adds panels A: the states ii, iii and iv of the first record and a dome, in space, at one scale
/// and with one colour bar. Measured joints are drawn over the state that they are nearest to.
/// Returns the positions of the shells that are drawn, "A1–A3 at (*L̄*_{d}, *n*) = (0.8, 12), A4 at
/// ...", or an empty text.
Result<std::string> add_states(Page& page, const Runs& records, render::MovieStyle style,
                               render::Renderer& renderer, Watch& watch) {
  const Run& one = *records.front();
  std::vector<std::size_t> which;
  for (const StateClass kind : {StateClass::ii, StateClass::iii, StateClass::iv})
    if (const auto found = lowest_of(kind, one)) which.push_back(found->at);
  if (which.empty()) {
    page.add_empty("A", above, "none of the states ii, iii and iv was found");
    return std::string();
  }
  const auto dome = lowest_of(StateClass::i, records);
  const double wider = dome ? width_over(dome->record->trajectory, one.trajectory) : 0;
  const double width = above.width / (3 + wider), dpi = one.preset.figure.dpi,
               height = above.height - caption / points_per_mm;
  style.captions = style.inset = style.legends = false;
  style.turn_deg = 0;
  const record::Trajectory run = render::states_alone(one.trajectory, which, style);
  const render::Stage stage(run, at_size(style, width, height, dpi));
  const Eigen::Matrix3Xd measured = scan_of(one.preset);
  const int over = state_measured(measured, run);
  for (std::size_t k = 0; k < which.size(); ++k) {
    if (watch.cancelled()) return fail(Fault::cancelled, "stopped while drawing a page");
    const Found found{&one, which[k]};
    render::Drawing drawing = stage.drawing(run.frames[k]);
    // computed joints are red, too, so they are not drawn if some were measured
    if (over >= 0) drawing.joint_diameter_mm = 0;
    if (over == int(k)) render::show_measured_joints(measured, drawing);
    TRY_DO(add_state(page, found, stage, std::move(drawing), "A" + std::to_string(k + 1),
                     fmt::format("{:#.3g} mJ", found.row().energy_mJ()),
                     {above.x + double(k) * width, above.y, width, above.height}, renderer));
    watch.report(double(k + 1) / double(which.size() + 1));
  }
  std::string drawn = which.size() > 1 ? fmt::format("A1–A{}", which.size()) : "A1";
  drawn += " at " + position_text(one.preset);
  if (dome) {
    const std::string letter = fmt::format("A{}", which.size() + 1);
    if (const std::string where = position_text(dome->record->preset); !where.empty())
      drawn += fmt::format(", {} at {}", letter, where);
    const record::Trajectory alone =
        render::states_alone(dome->record->trajectory, {dome->at}, style);
    render::MovieStyle wide = at_size(style, wider * width, height, dpi);
    const auto staged = [&] {
      return render::Stage(alone.layout, render::summarise_run(alone), wide, stage.colour_bar());
    };
    wide.zoom *= stage.pixels_per_mm() / staged().pixels_per_mm();
    const render::Stage wide_stage = staged();
    TRY_DO(add_state(page, *dome, wide_stage, wide_stage.drawing(alone.frames.front()), letter,
                     fmt::format("{:#.3g} mJ", dome->row().energy_mJ()),
                     {above.x + double(which.size()) * width, above.y, wider * width, above.height},
                     renderer));
  }
  if (const auto& bar = stage.colour_bar()) page.add_colour_bar({163, 3, 14, 28}, *bar);
  if (over >= 0) page.add_keys({128, 1, 32, 4}, {render::scan_key()});
  const double units = height * points_per_mm * stage.pixels_per_mm() / stage.style().height();
  page.add_scale_bar({159, 31, 18, 8}, stage.style().scale_bar_mm, units);
  return drawn;
}

Result<void> add_diagram(Page& page, const std::string& named) {
  if (named.empty()) {
    page.add_empty("B", diagram, "phase diagram: [page] sweep names no sweep");
    return {};
  }
  TRY(table, read_finished_sweep(named));
  if (!record::makes_phase_diagram(table->axes))
    return invalid(
        "[page] sweep = \"{}\": goes over other keys than footprint.longest_leg and "
        "footprint.rods",
        named);
  const std::string& of_case = table->rows.front().keys.case_name;
  page.add_plot("B", diagram, render::phase_plot(record::phase_diagram_of(*table, of_case), ""));
  return {};
}

/// Adds a note on what panels A show, and on what all shells of the page have in common.
void add_foot(Page& page, const preset::Preset& preset, const std::string& drawn) {
  if (preset.footprint.kind != preset::FootprintKind::circle) return;
  page.add_note(foot, fmt::format("{}{}*d* = {:g} mm, *R*_{{a}} = {:.3g} *R*_{{o}}", drawn,
                                  drawn.empty() ? "" : "; ", preset.footprint.spacing_mm,
                                  preset.actuated_radius_mm() / preset.original_radius_mm()));
  page.add_note({foot.x, foot.y + 4, foot.width, foot.height},
                "States of least elastic energy in their class. B: markers are displaced from "
                "their grey points.");
}

/// Adds panels C: a state of each class from above, each as large as its box.
void add_maps(Page& page, const Runs& records) {
  const double width = maps.width / 2, height = maps.height / 2;
  int index = 0;
  for (const StateClass kind : {StateClass::i, StateClass::ii, StateClass::iii, StateClass::iv}) {
    const Box box{maps.x + width * (index % 2), maps.y + height * (index / 2), width, height};
    const std::string letter = "C" + std::to_string(++index);
    const auto found = lowest_of(kind, records);
    if (!found) {
      page.add_empty(letter, box, "no state " + std::string(word_of(kind)));
      continue;
    }
    page.add(letter, page_name_of(found->row()), box,
             [found = *found, where = position_text(found->record->preset)](Canvas& canvas,
                                                                            const Box& inside) {
               const record::Layout& layout = found.record->trajectory.layout;
               const Box map{inside.x, inside.y, inside.width, inside.height - caption};
               render::draw_state_map(canvas, map, render::state_map_scale(map, layout), layout,
                                      found.frame(), found.row());
               canvas.text(where, {inside.middle().x, inside.bottom() - caption / 2},
                           {.size = page_font,
                            .align_x = render::AlignX::centre,
                            .align_y = render::AlignY::middle});
             });
  }
  page.add_keys({maps.x, maps.y + maps.height, maps.width, 5},
                {{render::first_order_ink, "first-mode buckling"},
                 {render::higher_order_ink, "higher-order buckling"}});
  page.add_keys({maps.x, maps.y + maps.height + 4, maps.width, 5},
                {{render::mirror_ink, "symmetry element"}});
}

}  // namespace

Result<Page> states_page(const Runs& records, const render::MovieStyle& style,
                         render::Renderer& renderer, Watch& watch) {
  const Run& first = *records.front();
  Page page{page_width, page_height};
  TRY(drawn, add_states(page, records, style, renderer, watch));
  TRY_DO(add_diagram(page, first.preset.page.sweep));
  add_maps(page, records);
  add_foot(page, first.preset, *drawn);
  return page;
}

}  // namespace gridshell::app
