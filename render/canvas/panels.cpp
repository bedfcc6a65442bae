#include "render/canvas/panels.h"

#include <algorithm>
#include <cmath>

#include "engine/core/try.h"
#include "render/canvas/text.h"

namespace gridshell::render {
namespace {

// the layout of a figure; lengths are in pixels of the panels
struct Grid {
  int columns, rows;
  double width, height;  // of a panel
  double em, gap, head, caption, margin, keys, foot, bar;
  Point origin = {};  // upper left corner of the figure

  double total_width() const { return 2 * margin + columns * width + (columns - 1) * gap + bar; }
  double total_height() const {
    return 2 * margin + head + rows * (height + caption) + (rows - 1) * gap + keys + foot;
  }
  Box panel(int index) const {
    return {origin.x + std::round(margin + (index % columns) * (width + gap)),
            origin.y + std::round(margin + head + (index / columns) * (height + caption + gap)),
            width, height};
  }
  double left() const { return origin.x + margin; }
  double top() const { return origin.y + margin; }
  double bottom() const { return origin.y + total_height() - margin; }
};

double bar_room(const PanelFigure& figure, const Grid& grid) {
  return std::max(8 * grid.em, figure.scale_bar_mm * figure.pixels_per_mm);
}

/// Whether the row of the keys has room for the scale bar too.
bool keys_next_to_bar(const PanelFigure& figure, const Grid& grid) {
  if (figure.keys.empty() || figure.arrow) return false;
  double width = bar_room(figure, grid);
  for (const ColourKey& key : figure.keys)
    width += grid.em * (3.7 + 0.6 * double(without_marks(key.name).size()));
  return width < grid.columns * (grid.width + grid.gap);
}

Grid make_grid(const PanelFigure& figure) {
  const int count = int(figure.panels.size());
  Grid grid{};
  grid.columns = std::clamp(figure.columns, 1, count);
  grid.rows = (count + grid.columns - 1) / grid.columns;
  grid.width = figure.panels[0].picture.width;
  grid.height = figure.panels[0].picture.height;
  // the font has 8.5 pt if the figure is printed width_mm wide; margins and bar add about a tenth
  const double pixels_per_pt =
      1.1 * grid.columns * grid.width / (figure.print.width_mm / 25.4 * 72);
  grid.em = std::max(7.5, 8.5 * pixels_per_pt);
  grid.gap = grid.margin = std::round(0.6 * grid.em);
  long lines = 0;
  for (const Panel& panel : figure.panels)
    if (!panel.caption.empty())
      lines = std::max(lines, 1 + std::ranges::count(panel.caption, '\n'));
  grid.caption = lines > 0 ? std::round((0.5 + 1.2 * double(lines)) * grid.em) : 0;
  grid.head = figure.title.empty() ? 0 : std::round(1.7 * grid.em);
  // a scale bar is in the row of the keys, if there is one
  grid.foot = figure.scale_bar_mm > 0 || figure.arrow ? std::round(1.9 * grid.em) : 0;
  grid.keys = figure.keys.empty() ? 0 : std::round(1.7 * grid.em);
  if (keys_next_to_bar(figure, grid)) grid.foot = 0;
  if (figure.colour_bar)
    grid.bar = grid.gap + std::ceil(colour_bar_width(*figure.colour_bar, grid.em));
  return grid;
}

void draw(Canvas& canvas, const PanelFigure& figure, const Grid& grid, bool lines) {
  const double em = grid.em;
  const double room = grid.total_width() - 2 * grid.margin;
  canvas.text(plain(figure.title), {grid.left(), grid.top() + grid.head / 2},
              canvas.fitted(plain(figure.title), room,
                            {.size = em, .bold = true, .align_y = AlignY::middle}));
  // all captions have one size, at which none is wider than its panel
  TextStyle caption{.size = em, .align_x = AlignX::centre, .align_y = AlignY::middle};
  for (const Panel& panel : figure.panels)
    caption = canvas.fitted(panel.caption, grid.width + 0.5 * grid.gap, caption);
  for (std::size_t k = 0; k < figure.panels.size(); ++k) {
    const Panel& panel = figure.panels[k];
    const Box box = grid.panel(int(k));
    if ((lines || figure.as_lines) && panel.lines)
      panel.lines(canvas, box);
    else
      canvas.picture(panel.picture, box);
    for (const PanelLabel& label : panel.labels)
      canvas.text(label.text, {box.x + label.at.x * box.width, box.y + label.at.y * box.height},
                  {.size = em,
                   .bold = label.bold,
                   .align_x = AlignX::centre,
                   .align_y = AlignY::middle,
                   .halo = {1, 1, 1, 0.8f}});
    if (!panel.letter.empty())
      canvas.text(
          panel.letter, {box.x + 0.4 * em, box.y + 0.2 * em},
          {.size = 1.2 * em, .bold = true, .align_y = AlignY::top, .halo = {1, 1, 1, 0.8f}});
    canvas.text(panel.caption, {box.middle().x, box.bottom() + grid.caption / 2}, caption);
  }
  const Box last = grid.panel(grid.columns - 1);
  const double left = grid.left(), bottom = grid.bottom();
  Box keys{left, bottom - grid.foot - grid.keys, last.right() - left, grid.keys};
  if (figure.scale_bar_mm > 0 && keys_next_to_bar(figure, grid)) {
    const double bar = bar_room(figure, grid);
    keys.width -= bar;
    draw_scale_bar(canvas, {keys.right(), keys.y - 0.3 * em, bar, keys.height}, figure.scale_bar_mm,
                   figure.pixels_per_mm, em);
  }
  draw_colour_keys(canvas, keys, figure.keys, em);
  if (grid.foot > 0) {
    Box row{left, bottom - grid.foot, last.right() - left, grid.foot};
    if (figure.arrow && figure.scale_bar_mm > 0) row.width /= 2;
    if (figure.arrow) draw_arrow_key(canvas, row, *figure.arrow, figure.pixels_per_mm, em);
    if (figure.arrow) row.x += row.width;
    draw_scale_bar(canvas, row, figure.scale_bar_mm, figure.pixels_per_mm, em);
  }
  if (figure.colour_bar) {
    // next to flat panels the bar is also next to their captions, so that its name has room
    const double least = std::min(grid.total_height() - 2 * grid.margin - grid.head, 13 * em);
    const double height = std::clamp(16 * em, least, std::max(least, grid.rows * grid.height));
    draw_colour_bar(canvas,
                    {last.right() + grid.gap, grid.top() + grid.head, grid.bar - grid.gap, height},
                    *figure.colour_bar, em);
  }
}

Result<void> check(const PanelFigure& figure) {
  if (figure.panels.empty()) return invalid("a figure needs at least one panel");
  const Image& first = figure.panels[0].picture;
  if (first.width < 1 || first.height < 1)
    return invalid("[movie] size: the picture is too small for its panels");
  for (const Panel& panel : figure.panels)
    if (panel.picture.width != first.width || panel.picture.height != first.height)
      return invalid("panels of a figure: expected one size, got {} x {} and {} x {}", first.width,
                     first.height, panel.picture.width, panel.picture.height);
  return {};
}

}  // namespace

Result<Image> draw_panels(const PanelFigure& figure) {
  TRY_DO(check(figure));
  const Grid grid = make_grid(figure);
  const double requested = figure.print.dpi * figure.print.width_mm / 25.4;
  const double scale = requested > 0 ? std::round(requested) / grid.total_width() : 1;
  return draw_picture(grid.total_width(), grid.total_height(), scale, figure.background,
                      [&](Canvas& canvas) { draw(canvas, figure, grid, false); });
}

Result<void> write_panels(const PanelFigure& figure, const std::filesystem::path& file,
                          double dpi) {
  TRY_DO(check(figure));
  const Grid grid = make_grid(figure);
  const auto draw_all = [&](Canvas& canvas) {
    draw_panels_on(canvas, {0, 0, canvas.width(), canvas.height()}, figure, true);
  };
  auto stem = std::filesystem::path(file).replace_extension();
  if (!figure.as_lines) {
    TRY(picture, draw_panels(figure));
    TRY_DO(write_png(*picture, file, dpi));
    if (!figure.panels.front().lines) return {};
    stem += "_lines";
  }
  const double width = figure.print.width_mm * points_per_mm;
  return write_figure(stem, width, width * grid.total_height() / grid.total_width(), figure.title,
                      draw_all,
                      {figure.print.width_mm, dpi > 0 ? dpi : Print{}.dpi, figure.background});
}

void draw_panels_on(Canvas& canvas, const Box& box, const PanelFigure& figure, bool lines) {
  if (!check(figure)) return;
  Grid grid = make_grid(figure);
  const double scale = std::min(box.width / grid.total_width(), box.height / grid.total_height());
  grid.origin = {box.middle().x / scale - grid.total_width() / 2,
                 box.middle().y / scale - grid.total_height() / 2};
  canvas.enlarged(scale, [&] { draw(canvas, figure, grid, lines); });
}

}  // namespace gridshell::render
