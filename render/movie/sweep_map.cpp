// The map of a sweep over two keys.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/canvas/legend.h"
#include "render/canvas/text.h"
#include "render/movie/sweep_chart.h"

namespace gridshell::render {
namespace {

using record::SweepTable;

constexpr double size = 8, margin = 5, panel = 150, gap = 14, title_room = 20, case_room = 13,
                 foot_room = 30, label_room = 44, bar_gap = 12, legend_room = 20;
constexpr Colour ink{0.1f, 0.1f, 0.12f, 1};

/// What a cell of the map is of.
struct Cell {
  double sum = 0;
  int found = 0, runs = 0;
  bool limited = false;

  double mean() const { return found > 0 ? sum / found : std::nan(""); }
};

/// The cells of one case, x fastest.
struct Panel {
  std::string name;
  std::vector<Cell> cells;
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
      Panel made{one, std::vector<Cell>(x_.texts.size() * y_.texts.size())};
      for (const auto& row : table.rows) {
        if (row.keys.case_name != one) continue;
        Cell& cell =
            made.cells[place_of(table, y_, row, 1) * x_.texts.size() + place_of(table, x_, row, 0)];
        const double value = number_of(row, view.figure);
        ++cell.runs;
        cell.limited = cell.limited || !limit_of(row).empty();
        if (!std::isfinite(value)) continue;
        cell.sum += value;
        ++cell.found;
      }
      for (const Cell& cell : made.cells) {
        if (cell.found > 0) values.push_back(cell.mean());
        any_limited_ = any_limited_ || cell.limited;
        any_lost_ = any_lost_ || (cell.runs > 0 && cell.found == 0);
      }
      panels_.push_back(std::move(made));
    }
    colours_ = scale_for(values);
  }

  double height() const {
    return 2 * margin + title_room + case_room + panel + foot_room + legend();
  }
  double width(const Canvas& canvas) const {
    return 2 * margin + label_room + double(panels_.size()) * (panel + gap) - gap + bar_gap +
           colour_bar_width(canvas, bar(), size);
  }

  void draw(Canvas& canvas) const {
    const double top = margin + title_room + case_room;
    canvas.text(plain(title_), {margin, margin},
                {.size = size + 1, .bold = true, .align_y = AlignY::top});
    double x = margin + label_room;
    for (const Panel& one : panels_) {
      draw_panel(canvas, one, {x, top, panel, panel}, &one == &panels_.front());
      x += panel + gap;
    }
    draw_colour_bar(canvas, {x - gap + bar_gap, top - case_room, 60, panel + case_room}, bar(),
                    size);
    draw_legend(canvas, {margin + label_room, top + panel + foot_room + 4});
  }

 private:
  static ColourScale scale_for(const std::vector<double>& values) {
    if (values.empty()) return {ColourMap::sequential, 0, 1};
    const auto [low, high] = std::ranges::minmax(values);
    if (low < 0 && high > 0) return symmetric_scale(values, 1);
    if (low == high) return {ColourMap::sequential, low - 0.5, high + 0.5};
    return {ColourMap::sequential, low, high};
  }
  ColourBar bar() const { return {label_, colours_}; }
  double legend() const { return any_limited_ || any_lost_ ? legend_room : 0; }

  void draw_panel(Canvas& canvas, const Panel& one, const Box& box, bool first) const {
    const double w = box.width / double(x_.texts.size()), h = box.height / double(y_.texts.size());
    for (std::size_t j = 0; j < y_.texts.size(); ++j)
      for (std::size_t i = 0; i < x_.texts.size(); ++i)
        // y grows upwards
        draw_cell(canvas, {box.x + w * double(i), box.bottom() - h * double(j + 1), w, h},
                  one.cells[j * x_.texts.size() + i]);
    canvas.rectangle(box, {0, 0, 0, 0}, {ink, 0.6});
    canvas.text(plain(one.name), {box.middle().x, box.y - 4},
                {.size = size, .align_x = AlignX::centre});
    label_columns(canvas, box, w);
    if (first) label_rows(canvas, box, h);
  }

  void draw_cell(Canvas& canvas, const Box& box, const Cell& cell) const {
    if (cell.found > 0) canvas.rectangle(box, colours_(cell.mean()), {{1, 1, 1, 1}, 0.5});
    const double r = std::min(4.0, 0.3 * std::min(box.width, box.height));
    if (cell.found == 0 && cell.runs > 0)
      canvas.marker(Marker::cross, box.middle(), 2 * r, ink, {ink, 0.8});
    else if (cell.limited)
      canvas.circle(box.middle(), 0.6 * r, {1, 1, 1, 1}, {ink, 0.6});
  }

  /// Every n-th value, as many as fit.
  static std::size_t stride(std::size_t count, double room, double cell) {
    return std::max<std::size_t>(1, std::size_t(std::ceil(room / cell - 1e-9)) * (count > 0));
  }
  static std::string text_at(const SweepScale& scale, std::size_t k) {
    return scale.is_number ? fmt::format("{:.4g}", scale.numbers[k])
                           : fmt::format("{}", scale.numbers[k]);
  }

  void label_columns(Canvas& canvas, const Box& box, double w) const {
    double widest = 0;
    for (std::size_t i = 0; i < x_.texts.size(); ++i)
      widest = std::max(widest, canvas.measure(text_at(x_, i), {.size = size - 1}).width + 4);
    for (std::size_t i = 0; i < x_.texts.size(); i += stride(x_.texts.size(), widest, w))
      canvas.text(text_at(x_, i), {box.x + w * (double(i) + 0.5), box.bottom() + 3},
                  {.size = size - 1, .align_x = AlignX::centre, .align_y = AlignY::top});
    canvas.text(x_.label, {box.middle().x, box.bottom() + 15},
                {.size = size, .align_x = AlignX::centre, .align_y = AlignY::top});
  }
  void label_rows(Canvas& canvas, const Box& box, double h) const {
    for (std::size_t j = 0; j < y_.texts.size(); j += stride(y_.texts.size(), size + 2, h))
      canvas.text(text_at(y_, j), {box.x - 3, box.bottom() - h * (double(j) + 0.5)},
                  {.size = size - 1, .align_x = AlignX::right, .align_y = AlignY::middle});
    canvas.text(
        y_.label, {margin + size / 2, box.middle().y},
        {.size = size, .align_x = AlignX::centre, .align_y = AlignY::middle, .angle_deg = 90});
  }

  void draw_legend(Canvas& canvas, Point at) const {
    const auto entry = [&](const std::string& text) {
      const Box box = canvas.text(text, {at.x + 8, at.y + size / 2},
                                  {.size = size - 0.5, .align_y = AlignY::middle});
      at.x = box.right() + 14;
    };
    if (any_limited_) {
      canvas.circle({at.x, at.y + size / 2}, 2.4, {1, 1, 1, 1}, {ink, 0.6});
      entry("ended early");
    }
    if (any_lost_) {
      canvas.marker(Marker::cross, {at.x, at.y + size / 2}, 6, ink, {ink, 0.8});
      entry("no state found");
    }
  }

  SweepScale x_, y_;
  std::string label_, title_;
  std::vector<Panel> panels_;
  ColourScale colours_;
  bool any_limited_ = false, any_lost_ = false;
};

}  // namespace

Result<void> write_sweep_map(const std::filesystem::path& stem, const SweepTable& table,
                             const SweepView& view) {
  const SweepMap map(table, view);
  double width = 0;
  draw_picture(1, 1, 1, {1, 1, 1, 1}, [&](Canvas& canvas) { width = map.width(canvas); });
  return write_figure(stem, width, map.height(), view.title,
                      [&](Canvas& canvas) { map.draw(canvas); });
}

}  // namespace gridshell::render
