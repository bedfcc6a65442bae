#include "app/states_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "app/pictures.h"
#include "app/state_pictures.h"
#include "app/sweep_folder.h"
#include "engine/record/legs.h"
#include "engine/record/phase_diagram.h"
#include "render/figure/net_figure.h"
#include "render/figure/phase_chart.h"
#include "render/figure/state_map.h"
#include "render/figure/vector_shell.h"
#include "render/movie/stage.h"
#include "render/plot/legend.h"

namespace gridshell::app {
namespace {

using record::StateClass;
using render::Box;
using render::Canvas;

// places on the page, mm
constexpr double page_width = 178, page_height = 152, margin = 2;
constexpr Box above{margin, margin, 160, 46}, diagram{margin, 50, 97, 94}, maps{101, 50, 75, 94},
    foot{margin, 145, 97, 5};
constexpr double points_per_mm = 72 / 25.4, caption = 12;  // points

/// A state of a record.
struct Found {
  const CaseRecord* record = nullptr;
  std::size_t at = 0;

  const record::StateRow& row() const { return record->states.rows[at]; }
  const record::Frame& frame() const { return record->run.frames[at]; }
};

/// The lowest of a class.
std::optional<Found> lowest_of(StateClass kind, const CaseRecord& record) {
  std::optional<Found> lowest;
  for (std::size_t k = 0; k < record.states.rows.size(); ++k) {
    const Found one{&record, k};
    if (one.row().kind == kind && (!lowest || one.row().energy_mJ() < lowest->row().energy_mJ()))
      lowest = one;
  }
  return lowest;
}

std::optional<Found> lowest_of(StateClass kind, const std::vector<CaseRecord>& records) {
  std::optional<Found> lowest;
  for (const CaseRecord& record : records)
    if (!lowest) lowest = lowest_of(kind, record);
  return lowest;
}

/// "(*L̄*_{d}, *n*) = (0.8, 12)"; empty where the footprint is no circle.
std::string place_of(const preset::Preset& preset) {
  if (preset.footprint.kind != preset::FootprintKind::circle) return "";
  const double radius = preset.original_radius_mm() / preset.footprint.spacing_mm;
  return fmt::format("(*L̄*_{{d}}, *n*) = ({:.3g}, {})",
                     record::longest_leg(radius, preset.footprint.rods), preset.footprint.rods);
}

/// Which of the states joints measured lie nearest to, by the mean distance to its own joints; -1:
/// none were measured.
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

/// The first record's states ii, iii and iv in space, at one scale and with one colour bar; joints
/// measured over the one that they lie nearest to.
Result<void> add_states(Page& page, const CaseRecord& one, render::MovieStyle style,
                        render::Renderer& renderer, Watch& watch) {
  std::vector<std::size_t> which;
  for (const StateClass kind : {StateClass::ii, StateClass::iii, StateClass::iv})
    if (const auto found = lowest_of(kind, one)) which.push_back(found->at);
  if (which.empty()) {
    page.add("A", "", above, [](Canvas& canvas, const Box& box) {
      render::draw_empty_frame(canvas, box, "none of the states ii, iii and iv was found");
    });
    return {};
  }
  const double width = above.width / 3;
  style = at_size(style, width, above.height - caption / points_per_mm, one.preset.figure.dpi);
  style.captions = style.inset = style.legends = false;
  style.turn_deg = 0;
  const record::Trajectory run = states_alone(one.run, which);
  const render::Stage stage(run, style);
  const Eigen::Matrix3Xd measured = scan_of(one.preset);
  const int over = state_measured(measured, run);
  for (std::size_t k = 0; k < which.size(); ++k) {
    if (watch.cancelled()) return fail(Fault::cancelled, "stopped while drawing a page");
    const record::StateRow& row = one.states.rows[which[k]];
    render::Drawing drawing = stage.drawing(run.frames[k]);
    // joints are drawn red too: where some are measured no others are
    if (over >= 0) drawing.joint_diameter_mm = 0;
    if (over == int(k)) render::dress_for_scan(measured, drawing);
    auto picture = renderer.draw(drawing, stage.camera(int(k)), render::draw_quality(style),
                                 style.width, style.height);
    if (!picture) return tl::unexpected(picture.error());
    render::Panel panel{std::move(*picture), "A" + std::to_string(k + 1), ""};
    if (style.vector) panel.lines = render::shell_lines(std::move(drawing), stage.camera(int(k)));
    page.add_panel(fmt::format("state *{}*, {}: {:.2f} mJ, {:.1f} mm high", word_of(row.kind),
                               group_text(row.group), row.energy_mJ(), row.height_mm),
                   {above.x + double(k) * width, above.y, width, above.height}, std::move(panel));
    watch.report(double(k + 1) / double(which.size()));
  }
  if (const auto& bar = stage.colour_bar()) page.add_colour_bar({162, 3, 14, 34}, *bar);
  if (over >= 0)
    page.add("", "", {128, 1, 32, 4}, [](Canvas& canvas, const Box& box) {
      render::draw_colour_keys(canvas, box, {render::scan_key()}, page_font);
    });
  const double units =
      (above.height * points_per_mm - caption) * stage.pixels_per_mm() / style.height;
  page.add("", "", {158, 38, 18, 8},
           [units, length = one.preset.figure.scale_bar_mm](Canvas& canvas, const Box& box) {
             render::draw_scale_bar(canvas, box, length, units, page_font);
           });
  return {};
}

Result<void> add_diagram(Page& page, const std::string& folder) {
  if (folder.empty()) {
    page.add("B", "", diagram, [](Canvas& canvas, const Box& box) {
      render::draw_empty_frame(canvas, box, "phase diagram: [page] sweep names no sweep");
    });
    return {};
  }
  const auto table = read_finished_sweep(folder);
  if (!table) return tl::unexpected(table.error());
  if (!record::makes_phase_diagram(table->axes))
    return fail(
        Fault::bad_input,
        fmt::format("[page] sweep = \"{}\": goes over other keys than footprint.longest_leg "
                    "and footprint.rods",
                    folder));
  const std::string& of_case = table->rows.front().keys.case_name;
  page.add_plot("B", diagram, render::phase_plot(record::phase_diagram_of(*table, of_case), ""));
  return {};
}

/// What all shells of the page have in common.
void add_foot(Page& page, const preset::Preset& preset) {
  const double d = preset.footprint.spacing_mm;
  const std::string shell =
      fmt::format("A at {}; all: circles, *d* = {:g} mm, *R*_{{a}} = {:.3g} *R*_{{o}}",
                  place_of(preset), d, preset.actuated_radius_mm() / preset.original_radius_mm());
  if (preset.footprint.kind == preset::FootprintKind::circle)
    page.add("", "", foot, [shell](Canvas& canvas, const Box& box) {
      canvas.text(shell, {box.x, box.middle().y},
                  {.size = page_font, .align_y = render::AlignY::middle});
    });
}

/// A state of each class from above, each as large as its place.
void add_maps(Page& page, const std::vector<CaseRecord>& records) {
  const double width = maps.width / 2, height = maps.height / 2;
  int place = 0;
  for (const StateClass kind : {StateClass::i, StateClass::ii, StateClass::iii, StateClass::iv}) {
    const Box box{maps.x + width * (place % 2), maps.y + height * (place / 2), width, height};
    const std::string letter = "C" + std::to_string(++place);
    const std::string name(word_of(kind));
    const auto found = lowest_of(kind, records);
    if (!found) {
      page.add(letter, "", box, [name](Canvas& canvas, const Box& inside) {
        render::draw_empty_frame(canvas, inside, "no state " + name);
      });
      continue;
    }
    const auto words = fmt::format("*{}*, {}", name, group_text(found->row().group));
    page.add(letter, words, box,
             [found = *found, where = place_of(found->record->preset)](Canvas& canvas,
                                                                       const Box& inside) {
               const record::Layout& layout = found.record->run.layout;
               const Box map{inside.x, inside.y, inside.width, inside.height - caption};
               render::draw_state_map(canvas, map, render::state_map_scale(map, layout), layout,
                                      found.frame(), found.row());
               canvas.text(where, {inside.middle().x, inside.bottom() - caption / 2},
                           {.size = page_font,
                            .align_x = render::AlignX::centre,
                            .align_y = render::AlignY::middle});
             });
  }
  page.add("", "", {maps.x, maps.y + maps.height, maps.width, 5},
           [](Canvas& canvas, const Box& box) {
             render::draw_colour_keys(canvas, box,
                                      {{render::first_order_ink, "rod of the first order"},
                                       {render::higher_order_ink, "with inflections"},
                                       {render::mirror_ink, "symmetry"}},
                                      page_font);
           });
}

}  // namespace

Result<Page> states_page(const std::vector<CaseRecord>& records, const render::MovieStyle& style,
                         render::Renderer& renderer, Watch& watch) {
  const CaseRecord& first = records.front();
  if (first.states.rows.empty())
    return fail(Fault::bad_input,
                fmt::format("{}: [page] kind = \"fig2\" shows states: must have [jitter] trials or "
                            "confined above 0",
                            first.preset.name));
  Page page{page_width, page_height};
  return add_states(page, first, style, renderer, watch)
      .and_then([&] { return add_diagram(page, first.preset.page.sweep); })
      .map([&] {
        add_maps(page, records);
        add_foot(page, first.preset);
        return std::move(page);
      });
}

}  // namespace gridshell::app
