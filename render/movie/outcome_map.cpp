#include "render/movie/validation_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "render/canvas/legend.h"
#include "render/canvas/text.h"
#include "render/movie/sweep_chart.h"

namespace gridshell::render {
namespace {

using record::RunOutcome;
using record::StabilityRow;

constexpr double points_per_mm = 72 / 25.4, size = 7.5;
constexpr double cell_width = 19.5, cell_height = 12, label_room = 21, gap = 4;
constexpr double head_room = 12, foot_room = 24, map_room = 15, heading_gap = 30, title_room = 18,
                 legend_room = 34;
constexpr Colour ink{0.1f, 0.1f, 0.12f, 1};

/// 0.95, 30, 10^{−6}
std::string number(double value) {
  if (value != 0 && (std::abs(value) < 1e-2 || std::abs(value) >= 1e4)) {
    const double power = std::log10(std::abs(value));
    if (std::abs(power - std::lround(power)) < 1e-9)
      return fmt::format("10^{{{}{}}}", power < 0 ? "−" : "", std::abs(std::lround(power)));
  }
  return fmt::format("{:g}", value);
}

/// The cells of one method on one map.
struct Panel {
  std::string map, method, x_name, y_name;
  std::vector<double> x, y;  ///< ascending
  std::vector<const StabilityRow*> cells;

  double width() const { return label_room + cell_width * double(x.size()); }
  double height() const { return head_room + cell_height * double(y.size()) + foot_room; }
};

std::vector<Panel> panels_of(const std::vector<StabilityRow>& rows) {
  std::vector<Panel> panels;
  for (const StabilityRow& row : rows) {
    auto at = std::find_if(panels.begin(), panels.end(), [&](const Panel& panel) {
      return panel.map == row.map && panel.method == row.method;
    });
    if (at == panels.end())
      at = panels.insert(at, {row.map, row.method, row.x_name, row.y_name, {}, {}, {}});
    at->cells.push_back(&row);
  }
  for (Panel& panel : panels) {
    std::set<double> x, y;
    for (const StabilityRow* cell : panel.cells) x.insert(cell->x), y.insert(cell->y);
    panel.x.assign(x.begin(), x.end());
    panel.y.assign(y.begin(), y.end());
  }
  return panels;
}

/// Where everything goes: panels of a map beside one another, as many as fit.
struct Place {
  const Panel* panel;
  Point at;
  bool first;  ///< of its map: the map's name stands above
};

std::vector<Place> places_of(const std::vector<Panel>& panels, double width, double* height) {
  std::vector<Place> places;
  double x = 0, y = title_room, row = 0;
  for (std::size_t k = 0; k < panels.size(); ++k) {
    const Panel& panel = panels[k];
    const bool first = k == 0 || panels[k - 1].map != panel.map;
    // a map of one panel may stand beside the one before
    const bool fits = k > 0 && x + panel.width() + (first ? heading_gap : 0) <= width;
    const auto alone = [&](const std::string& map) {
      return std::count_if(panels.begin(), panels.end(),
                           [&](const Panel& other) { return other.map == map; }) == 1;
    };
    const bool joins = fits && (!first || (alone(panel.map) && alone(panels[k - 1].map)));
    if (!joins && k > 0) {
      y += row;
      x = row = 0;
    }
    if (joins && first) x += heading_gap;
    places.push_back({&panel, {x, y}, first});
    x += panel.width() + gap;
    row = std::max(row, panel.height() + map_room);
  }
  *height = y + row + legend_room;
  return places;
}

void draw_cell(Canvas& canvas, const Box& box, RunOutcome outcome) {
  canvas.rectangle(box, outcome_colour(outcome), {{1, 1, 1, 1}, 1});
  if (!record::silently_wrong(outcome)) return;
  // legible without colours
  const Point m = box.middle();
  const double r = 0.22 * box.height;
  const Stroke white{{1, 1, 1, 1}, 1};
  canvas.line({m.x - r, m.y - r}, {m.x + r, m.y + r}, white);
  canvas.line({m.x - r, m.y + r}, {m.x + r, m.y - r}, white);
}

void draw_panel(Canvas& canvas, const Panel& panel, Point at) {
  const double left = at.x + label_room, top = at.y + head_room;
  const double width = cell_width * double(panel.x.size());
  const double height = cell_height * double(panel.y.size());
  canvas.text(plain(panel.method), {left + width / 2, top - 3},
              {.size = size, .align_x = AlignX::centre});
  // y grows upwards
  const auto row_of = [&](std::size_t k) {
    return top + cell_height * double(panel.y.size() - 1 - k);
  };
  for (const StabilityRow* cell : panel.cells) {
    const auto column = std::lower_bound(panel.x.begin(), panel.x.end(), cell->x);
    const auto row = std::lower_bound(panel.y.begin(), panel.y.end(), cell->y);
    draw_cell(canvas,
              {left + cell_width * double(column - panel.x.begin()),
               row_of(std::size_t(row - panel.y.begin())), cell_width, cell_height},
              cell->outcome);
  }
  canvas.rectangle({left, top, width, height}, {0, 0, 0, 0}, {ink, 0.6});
  // where theory puts the edge of a step over its limit
  const auto beyond = std::upper_bound(panel.x.begin(), panel.x.end(), 1.0);
  if (panel.x_name.starts_with("step over") && beyond != panel.x.begin() &&
      beyond != panel.x.end()) {
    const double x = left + cell_width * double(beyond - panel.x.begin());
    canvas.line({x, top - 1}, {x, top + height + 1}, {ink, 1.4, {3, 2}});
  }
  for (std::size_t k = 0; k < panel.x.size(); ++k)
    canvas.text(number(panel.x[k]), {left + cell_width * (double(k) + 0.5), top + height + 2},
                {.size = size - 1.5, .align_x = AlignX::centre, .align_y = AlignY::top});
  for (std::size_t k = 0; k < panel.y.size(); ++k)
    canvas.text(number(panel.y[k]), {left - 3, row_of(k) + cell_height / 2},
                {.size = size - 1, .align_x = AlignX::right, .align_y = AlignY::middle});
  canvas.text(label_of(panel.x_name), {left + width / 2, top + height + 11},
              {.size = size - 1, .align_x = AlignX::centre, .align_y = AlignY::top});
}

void draw_legend(Canvas& canvas, Point at, double width) {
  // what a user would notice above, what not below
  Patches patches{.row_width = width, .row_height = 15, .font_size = size};
  patches.draw = [&](std::size_t k, const Box& box) { draw_cell(canvas, box, RunOutcome(k)); };
  for (const auto& [outcome, word] : words_of<RunOutcome>())
    patches.names.push_back(outcome_label(outcome));
  draw_patches(canvas, {at.x, at.y, 18, 10}, patches);
}

}  // namespace

Colour outcome_colour(RunOutcome outcome) {
  switch (outcome) {
    case RunOutcome::right:
      return hex_colour(0x8CC7A1);
    case RunOutcome::refused:
      return hex_colour(0xC9CDD3);
    case RunOutcome::not_converged:
      return hex_colour(0xF0E2A8);
    case RunOutcome::blow_up:
      return hex_colour(0xF2B36B);
    case RunOutcome::too_slow:
      return hex_colour(0xA9C4E6);
    case RunOutcome::planar_saddle:
      return hex_colour(0x7A3B8F);
    case RunOutcome::other_state:
      return hex_colour(0xB0417C);
    case RunOutcome::silent_wrong:
      break;
  }
  return hex_colour(0xC0262B);
}

std::string outcome_label(RunOutcome outcome) {
  const std::string name = spaced(std::string(word_of(outcome)));
  return record::silently_wrong(outcome) && outcome != RunOutcome::silent_wrong ? "silent: " + name
                                                                                : name;
}

double outcome_maps_height(const std::vector<StabilityRow>& rows, double width) {
  const auto panels = panels_of(rows);
  double height = 0;
  places_of(panels, width, &height);
  return height;
}

void draw_outcome_maps(Canvas& canvas, const Box& box, const std::vector<StabilityRow>& rows,
                       const std::string& title) {
  const auto panels = panels_of(rows);
  double height = 0;
  canvas.text(
      title, {box.middle().x, box.y + 2},
      {.size = size + 1.5, .bold = true, .align_x = AlignX::centre, .align_y = AlignY::top});
  for (const Place& place : places_of(panels, box.width, &height)) {
    const Point at{box.x + place.at.x, box.y + place.at.y};
    if (place.first)
      canvas.text(plain(place.panel->map + ", by " + spaced(place.panel->y_name)),
                  {at.x + 4, at.y + 4}, {.size = size + 0.5, .bold = true, .align_y = AlignY::top});
    draw_panel(canvas, *place.panel, {at.x, at.y + map_room});
  }
  draw_legend(canvas, {box.x + 4, box.y + height - legend_room + 4}, box.width);
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

}  // namespace gridshell::render
