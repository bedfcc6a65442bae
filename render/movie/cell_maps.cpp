// Maps of coloured cells: outcomes of methods, and a sweep over two keys.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "render/canvas/legend.h"
#include "render/canvas/text.h"
#include "render/movie/sweep_chart.h"
#include "render/movie/validation_charts.h"

namespace gridshell::render {
namespace {

using record::RunOutcome;
using record::StabilityRow;
using record::SweepTable;

/// A frame around cells of one size, with a name above and texts at its columns and rows.
struct CellMap {
  Box box;
  std::string name, x_label;                ///< text with markup
  std::vector<std::string> x = {}, y = {};  ///< a text per column and, from below, per row
  double size = 8, column_size = 7, row_size = 7, label_size = 8;  ///< of fonts
  double name_room = 4, column_room = 3, label_room = 15;          ///< from the frame to the texts
  bool rows_named = true;

  double cell_width() const { return box.width / double(x.size()); }
  double cell_height() const { return box.height / double(y.size()); }
  Box cell(std::size_t i, std::size_t j) const {
    return {box.x + cell_width() * double(i), box.bottom() - cell_height() * double(j + 1),
            cell_width(), cell_height()};
  }
};

/// The n for which every n-th text fits: texts need `room`, cells are `cell` wide.
std::size_t stride(double room, double cell) {
  return std::max<std::size_t>(1, std::size_t(std::ceil(room / cell - 1e-9)));
}

/// Draws the frame with its texts, after the cells.
void draw_frame(Canvas& canvas, const CellMap& map) {
  const Box& box = map.box;
  canvas.rectangle(box, {0, 0, 0, 0}, {ink, 0.6});
  canvas.text(map.name, {box.middle().x, box.y - map.name_room},
              {.size = map.size, .align_x = AlignX::centre});
  double widest = 0;
  for (const std::string& text : map.x)
    widest = std::max(widest, canvas.measure(text, {.size = map.column_size}).width);
  for (std::size_t i = 0; i < map.x.size(); i += stride(widest + 4, map.cell_width()))
    canvas.text(map.x[i], {map.cell(i, 0).middle().x, box.bottom() + map.column_room},
                {.size = map.column_size, .align_x = AlignX::centre, .align_y = AlignY::top});
  canvas.text(map.x_label, {box.middle().x, box.bottom() + map.label_room},
              {.size = map.label_size, .align_x = AlignX::centre, .align_y = AlignY::top});
  if (!map.rows_named) return;
  for (std::size_t j = 0; j < map.y.size(); j += stride(map.size + 2, map.cell_height()))
    canvas.text(map.y[j], {box.x - 3, map.cell(0, j).middle().y},
                {.size = map.row_size, .align_x = AlignX::right, .align_y = AlignY::middle});
}

constexpr double size = 7.5;
constexpr double cell_width = 19.5, cell_height = 12, label_room = 21, gap = 4;
constexpr double head_room = 12, foot_room = 24, map_room = 15, heading_gap = 30, title_room = 18,
                 legend_room = 34;

/// A number as text: 0.95, 30, 10^{−6}.
std::string number(double value) {
  if (value != 0 && (std::abs(value) < 1e-2 || std::abs(value) >= 1e4)) {
    const double power = std::log10(std::abs(value));
    if (std::abs(power - std::lround(power)) < 1e-9)
      return fmt::format("10^{{{}{}}}", power < 0 ? "−" : "", std::abs(std::lround(power)));
  }
  return fmt::format("{:g}", value);
}

/// The cells of one method on one map.
struct MethodPanel {
  std::string map, method, x_name, y_name;
  std::set<double> x, y;
  std::vector<const StabilityRow*> cells;

  double width() const { return label_room + cell_width * double(x.size()); }
  double height() const { return head_room + cell_height * double(y.size()) + foot_room; }
};

std::vector<MethodPanel> panels_of(const std::vector<StabilityRow>& rows) {
  std::vector<MethodPanel> panels;
  for (const StabilityRow& row : rows) {
    auto at = std::ranges::find_if(panels, [&](const MethodPanel& panel) {
      return panel.map == row.map && panel.method == row.method;
    });
    if (at == panels.end())
      at = panels.insert(at, {row.map, row.method, row.x_name, row.y_name, {}, {}, {}});
    at->x.insert(row.x);
    at->y.insert(row.y);
    at->cells.push_back(&row);
  }
  return panels;
}

/// The position of a panel. Panels of a map are side by side, as many as fit.
struct PanelPosition {
  const MethodPanel* panel;
  Point at;
  bool first;  ///< of its map: the map's name is above
};

std::vector<PanelPosition> panel_positions(const std::vector<MethodPanel>& panels, double width,
                                           double* height) {
  std::vector<PanelPosition> positions;
  double x = 0, y = title_room, row = 0;
  for (std::size_t k = 0; k < panels.size(); ++k) {
    const MethodPanel& panel = panels[k];
    const bool first = k == 0 || panels[k - 1].map != panel.map;
    // maps of one panel may be side by side
    const bool fits = k > 0 && x + panel.width() + (first ? heading_gap : 0) <= width;
    const auto alone = [&](const std::string& map) {
      return std::ranges::count(panels, map, &MethodPanel::map) == 1;
    };
    const bool joins = fits && (!first || (alone(panel.map) && alone(panels[k - 1].map)));
    if (!joins && k > 0) {
      y += row;
      x = row = 0;
    }
    if (joins && first) x += heading_gap;
    positions.push_back({&panel, {x, y}, first});
    x += panel.width() + gap;
    row = std::max(row, panel.height() + map_room);
  }
  *height = y + row + legend_room;
  return positions;
}

void draw_outcome(Canvas& canvas, const Box& box, RunOutcome outcome) {
  canvas.rectangle(box, outcome_colour(outcome), {white, 1});
  // every outcome has a sign, which is legible without colours
  const Point m = box.middle();
  const double r = 0.22 * box.height;
  const Stroke stroke{record::silently_wrong(outcome) ? white : ink, 1};
  const auto line = [&](double x0, double y0, double x1, double y1) {
    canvas.line({m.x + r * x0, m.y + r * y0}, {m.x + r * x1, m.y + r * y1}, stroke);
  };
  switch (outcome) {
    case RunOutcome::right:
      return;
    case RunOutcome::refused:
      return line(-1, 0, 1, 0);
    case RunOutcome::not_converged:
      return line(-1, 1, 1, -1);
    case RunOutcome::blow_up:
      line(-1, 0.6, 0, -0.8);
      return line(0, -0.8, 1, 0.6);
    case RunOutcome::too_slow:
      return canvas.circle(m, 0.45 * r, ink);
    case RunOutcome::planar_saddle:
      line(-1, 0, 1, 0);
      return line(0, -1, 0, 1);
    case RunOutcome::silent_wrong:
      canvas.circle(m, 1.5 * r, {0, 0, 0, 0}, stroke);
      [[fallthrough]];
    case RunOutcome::other_state:
      line(-1, -1, 1, 1);
      return line(-1, 1, 1, -1);
  }
}

void draw_panel(Canvas& canvas, const MethodPanel& panel, Point at) {
  CellMap map{.box = {at.x + label_room, at.y + head_room, panel.width() - label_room,
                      cell_height * double(panel.y.size())},
              .name = plain(panel.method),
              .x_label = label_of(panel.x_name) +
                         (panel.x_name.starts_with("step over") ? "; dashed: limit" : ""),
              .size = size,
              .column_size = size - 1.5,
              .row_size = size - 1,
              .label_size = size - 1,
              .name_room = 3,
              .column_room = 2,
              .label_room = 11};
  for (const double x : panel.x) map.x.push_back(number(x));
  for (const double y : panel.y) map.y.push_back(number(y));
  const auto index = [](const std::set<double>& all, double value) {
    return std::size_t(std::distance(all.begin(), all.find(value)));
  };
  for (const StabilityRow* cell : panel.cells)
    draw_outcome(canvas, map.cell(index(panel.x, cell->x), index(panel.y, cell->y)), cell->outcome);
  draw_frame(canvas, map);
  // a line at x = 1, the theoretical limit of a "step over"
  const auto past_limit = panel.x.upper_bound(1.0);
  if (!panel.x_name.starts_with("step over") || past_limit == panel.x.begin() ||
      past_limit == panel.x.end())
    return;
  const double x = map.cell(index(panel.x, *past_limit), 0).x;
  canvas.line({x, map.box.y - 1}, {x, map.box.bottom() + 1}, {ink, 1.4, {3, 2}});
}

/// The runs of one cell of a sweep's map.
struct SweepCell {
  double sum = 0;
  int found = 0, failed = 0;  ///< runs with the figure, runs without a state
  bool limited = false, unstable = false;

  bool is_known() const { return found > 0; }
  double mean() const { return is_known() ? sum / found : std::nan(""); }
  bool lost() const { return failed > 0 && !is_known(); }
  bool is_marked() const { return limited || unstable || lost(); }
};

/// The cells of one case, x fastest.
struct CasePanel {
  std::string name;
  std::vector<SweepCell> cells;
};

class SweepMap {
 public:
  SweepMap(const SweepTable& table, const SweepView& view)
      : x_(scale_of(table, 0)),
        y_(scale_of(table, 1)),
        label_(label_of(view.figure)),
        title_(view.title) {
    std::vector<double> values;
    for (const auto& one : cases_of(table)) {
      CasePanel made{one, std::vector<SweepCell>(x_.texts.size() * y_.texts.size())};
      for (const auto& row : table.rows) {
        if (row.keys.case_name != one) continue;
        SweepCell& cell = made.cells[index_on_scale(table, y_, row, 1) * x_.texts.size() +
                                     index_on_scale(table, x_, row, 0)];
        const double value = number_of(row, view.figure);
        cell.failed += row.result.outcome != record::PointOutcome::done;
        cell.limited = cell.limited || !limit_of(row).empty();
        cell.unstable = cell.unstable || is_unstable(row);
        if (!std::isfinite(value)) continue;
        cell.sum += value;
        ++cell.found;
      }
      for (const SweepCell& cell : made.cells)
        if (cell.is_known()) values.push_back(cell.mean());
      panels_.push_back(std::move(made));
    }
    bar_ = {label_, scale_for(values)};
  }

  double height() const {
    const double legend = !any(&SweepCell::is_known) || any(&SweepCell::is_marked) ? 20 : 0;
    return 2 * margin + title_room + case_room + panel + foot_room + legend;
  }
  double width() const {
    return 2 * margin + label_room + double(panels_.size()) * (panel + gap) - gap + bar_gap +
           colour_bar_width(bar_, size);
  }

  void draw(Canvas& canvas) const {
    const double top = margin + title_room + case_room;
    canvas.text(plain(title_), {margin, margin},
                {.size = size + 1, .bold = true, .align_y = AlignY::top});
    double x = margin + label_room;
    for (const CasePanel& one : panels_) {
      draw_case(canvas, one, {x, top, panel, panel}, &one == &panels_.front());
      x += panel + gap;
    }
    canvas.text(
        y_.label, {margin + size / 2, top + panel / 2},
        {.size = size, .align_x = AlignX::centre, .align_y = AlignY::middle, .angle_deg = 90});
    const double bottom = top + panel + foot_room + 4 + size / 2;
    if (!any(&SweepCell::is_known)) {
      canvas.text("no run has " + label_, {margin + label_room, bottom},
                  {.size = size, .align_y = AlignY::middle});
      return;
    }
    draw_colour_bar(canvas, {x - gap + bar_gap, top - case_room, 60, panel + case_room}, bar_,
                    size);
    draw_legend(canvas, {margin + label_room, bottom});
  }

 private:
  static constexpr double size = 8, margin = 5, panel = 150, gap = 14, title_room = 20,
                          case_room = 13, foot_room = 30, label_room = 44, bar_gap = 12;

  /// Whether a cell of any case is so.
  bool any(auto is) const {
    return std::ranges::any_of(
        panels_, [&](const CasePanel& one) { return std::ranges::any_of(one.cells, is); });
  }

  static ColourScale scale_for(const std::vector<double>& values) {
    if (values.empty()) return {sequential, 0, 1};
    const auto [low, high] = std::ranges::minmax(values);
    if (low < 0 && high > 0) return symmetric_scale(values, 1);
    if (low == high) return {sequential, low - 0.5, high + 0.5};
    return {sequential, low, high};
  }

  static std::vector<std::string> texts_of(const SweepScale& scale) {
    std::vector<std::string> texts;
    for (const double number : scale.numbers)
      texts.push_back(scale.is_number ? fmt::format("{:.4g}", number) : fmt::format("{}", number));
    return texts;
  }

  void draw_case(Canvas& canvas, const CasePanel& one, const Box& box, bool first) const {
    const CellMap map{.box = box,
                      .name = plain(one.name),
                      .x_label = x_.label,
                      .x = texts_of(x_),
                      .y = texts_of(y_),
                      .rows_named = first};
    for (std::size_t k = 0; k < one.cells.size(); ++k)
      draw_cell(canvas, map.cell(k % map.x.size(), k / map.x.size()), one.cells[k]);
    draw_frame(canvas, map);
  }

  void draw_cell(Canvas& canvas, const Box& box, const SweepCell& cell) const {
    if (cell.found > 0) canvas.rectangle(box, bar_.scale(cell.mean()), {white, 0.5});
    const double r = std::min(4.0, 0.3 * std::min(box.width, box.height));
    if (cell.lost())
      canvas.marker(Marker::cross, box.middle(), 2 * r, ink, {ink, 0.8});
    else if (cell.unstable)
      canvas.marker(Marker::diamond, box.middle(), 1.6 * r, white, {ink, 0.6});
    else if (cell.limited)
      canvas.circle(box.middle(), 0.6 * r, white, {ink, 0.6});
  }

  void draw_legend(Canvas& canvas, Point at) const {
    const auto entry = [&](const std::string& text) {
      const TextStyle style{.size = size - 0.5, .align_y = AlignY::middle};
      at.x = canvas.text(text, {at.x + 8, at.y}, style).right() + 14;
    };
    if (any(&SweepCell::limited)) {
      canvas.circle(at, 2.4, white, {ink, 0.6});
      entry("ended early");
    }
    if (any(&SweepCell::unstable)) {
      canvas.marker(Marker::diamond, at, 5, white, {ink, 0.6});
      entry("unstable");
    }
    if (any(&SweepCell::lost)) {
      canvas.marker(Marker::cross, at, 6, ink, {ink, 0.8});
      entry("no state found");
    }
  }

  SweepScale x_, y_;
  std::string label_, title_;
  std::vector<CasePanel> panels_;
  ColourBar bar_;
};

}  // namespace

Colour outcome_colour(RunOutcome outcome) {
  // from right to silent_wrong
  constexpr std::array<long, words_of<RunOutcome>().size()> colours{
      0x8CC7A1, 0xC9CDD3, 0xF0E2A8, 0xF2B36B, 0xA9C4E6, 0x7A3B8F, 0xB0417C, 0xC0262B};
  return hex_colour(colours[std::size_t(outcome)]);
}

std::string outcome_label(RunOutcome outcome) {
  const std::string name =
      outcome == RunOutcome::blow_up ? "diverged" : spaced(std::string(word_of(outcome)));
  return record::silently_wrong(outcome) && outcome != RunOutcome::silent_wrong ? "silent: " + name
                                                                                : name;
}

double outcome_maps_height(const std::vector<StabilityRow>& rows, double width) {
  const auto panels = panels_of(rows);
  double height = 0;
  panel_positions(panels, width, &height);
  return height;
}

void draw_outcome_maps(Canvas& canvas, const Box& box, const std::vector<StabilityRow>& rows,
                       const std::string& title) {
  const auto panels = panels_of(rows);
  double height = 0;
  canvas.text(
      title, {box.middle().x, box.y + 2},
      {.size = size + 1.5, .bold = true, .align_x = AlignX::centre, .align_y = AlignY::top});
  for (const PanelPosition& one : panel_positions(panels, box.width, &height)) {
    const Point at{box.x + one.at.x, box.y + one.at.y};
    if (one.first)
      canvas.text(plain(one.panel->map + "; rows: " + spaced(one.panel->y_name)),
                  {at.x + 4, at.y + 4}, {.size = size + 0.5, .bold = true, .align_y = AlignY::top});
    draw_panel(canvas, *one.panel, {at.x, at.y + map_room});
  }
  // the first row of patches has the outcomes that a user would notice
  Patches patches{.row_width = box.width, .row_height = 15, .font_size = size};
  patches.draw = [&](std::size_t k, const Box& patch) {
    draw_outcome(canvas, patch, RunOutcome(k));
  };
  for (const auto& [outcome, word] : words_of<RunOutcome>())
    patches.names.push_back(outcome_label(outcome));
  draw_patches(canvas, {box.x + 4, box.y + height - legend_room + 4, 18, 10}, patches);
}

Result<void> write_outcome_maps(const std::filesystem::path& stem,
                                const std::vector<StabilityRow>& rows, const std::string& title,
                                double width_mm) {
  const double width = width_mm * points_per_mm, margin = 4;
  const double height = outcome_maps_height(rows, width - 2 * margin) + 2 * margin;
  return write_figure(stem, width, height, title, [&](Canvas& canvas) {
    draw_outcome_maps(canvas, Box{0, 0, width, height}.inset(margin), rows, title);
  });
}

Result<void> write_sweep_map(const std::filesystem::path& stem, const SweepTable& table,
                             const SweepView& view, const Print& print) {
  const SweepMap map(table, view);
  return write_figure(
      stem, map.width(), map.height(), view.title, [&](Canvas& canvas) { map.draw(canvas); },
      print);
}

}  // namespace gridshell::render
