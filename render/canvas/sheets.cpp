#include "render/canvas/sheets.h"

#include <fmt/format.h>
#include <algorithm>
#include <utility>

#include "render/canvas/text.h"

namespace gridshell::render {
namespace {

constexpr double a4_width = 595.28, a4_height = 841.89, margin = 42, foot = 20;  // points
constexpr double wide = a4_width - 2 * margin, line = 12, between = 8;
const Colour red{0.7f, 0.1f, 0.1f, 1}, grey{0.45f, 0.45f, 0.48f, 1};
const TextStyle usual{.size = 8.5};

/// How text is broken, before there is a sheet to draw it on.
std::vector<std::string> lines_of(const std::string& text, double width, const TextStyle& style) {
  std::vector<std::string> lines;
  draw_picture(8, 8, 1, white, [&](Canvas& canvas) { lines = canvas.wrapped(text, width, style); });
  return lines;
}

/// The left edge and the width of every column.
std::vector<std::pair<double, double>> places_of(const std::vector<TableColumn>& columns) {
  constexpr double gap = 8;
  double known = gap * double(columns.size() - 1);
  for (const TableColumn& column : columns) known += column.width;
  std::vector<std::pair<double, double>> places;
  double x = margin;
  for (const TableColumn& column : columns) {
    const double width = column.width > 0 ? column.width : wide - known;
    places.emplace_back(x, width);
    x += width + gap;
  }
  return places;
}

void draw_cell(Canvas& canvas, const std::string& marked, const std::pair<double, double>& place,
               double y, TextStyle style) {
  const auto [x, width] = place;
  const Point at{style.align_x == AlignX::right ? x + width : x, y + line - 3};
  canvas.text(marked, at, canvas.fitted(marked, width, style));
}

}  // namespace

void Sheets::heading(const std::string& plain_text, double size) {
  add({1.9 * size,
       [=](Canvas& canvas, double y) {
         const TextStyle style{.size = size, .bold = true};
         canvas.text(plain(plain_text), {margin, y + 1.4 * size},
                     canvas.fitted(plain(plain_text), wide, style));
       },
       true});
}

void Sheets::text(const std::string& plain_text) {
  for (const std::string& words : lines_of(plain_text, wide, usual))
    add({line, [=](Canvas& canvas, double y) {
           canvas.text(plain(words), {margin, y + line - 3}, usual);
         }});
  add({between / 2, {}});
}

void Sheets::table(const std::vector<TableColumn>& columns, const std::vector<TableRow>& rows) {
  const auto places = places_of(columns);
  const std::size_t head = items_.size();
  add({line + 3,
       [=](Canvas& canvas, double y) {
         for (std::size_t k = 0; k < columns.size(); ++k)
           draw_cell(canvas, columns[k].title, places[k], y,
                     {.size = usual.size, .bold = true, .align_x = columns[k].align});
         canvas.line({margin, y + line + 1}, {a4_width - margin, y + line + 1}, {ink, 0.6});
       },
       true});
  for (const TableRow& row : rows) {
    std::vector<std::vector<std::string>> cells;
    std::size_t lines = 1;
    for (std::size_t k = 0; k < row.cells.size(); ++k) {
      cells.push_back(columns[k].width > 0 ? std::vector<std::string>{row.cells[k]}
                                           : lines_of(row.cells[k], places[k].second, usual));
      lines = std::max(lines, cells.back().size());
    }
    add({line * double(lines),
         [=, colour = row.stands_out ? red : ink](Canvas& canvas, double y) {
           for (std::size_t k = 0; k < cells.size(); ++k)
             for (std::size_t n = 0; n < cells[k].size(); ++n)
               draw_cell(canvas, plain(cells[k][n]), places[k], y + line * double(n),
                         {.size = usual.size, .colour = colour, .align_x = columns[k].align});
         },
         false, head});
  }
  add({between, {}});
}

void Sheets::values(const std::vector<std::pair<std::string, std::string>>& pairs) {
  constexpr double half = wide / 2, name = 0.5 * half;
  for (std::size_t k = 0; k < pairs.size(); k += 2)
    add({line, [=](Canvas& canvas, double y) {
           for (std::size_t n = k; n < std::min(k + 2, pairs.size()); ++n) {
             const double x = margin + (n == k ? 0 : half);
             draw_cell(canvas, plain(pairs[n].first), {x, name - 6}, y,
                       {.size = usual.size, .colour = grey});
             draw_cell(canvas, plain(pairs[n].second), {x + name, half - name - 8}, y, usual);
           }
         }});
  add({between, {}});
}

void Sheets::picture(const Image& image) {
  const double height = wide * image.height / image.width;
  add({height + between, [=](Canvas& canvas, double y) {
         canvas.picture(image, {margin, y, wide, height});
       }});
}

void Sheets::plot(const Plot& plot, double height) {
  add({height + between, [=](Canvas& canvas, double y) {
         draw_plot(canvas, {margin, y, wide, height}, plot);
       }});
}

void Sheets::next_sheet() { add({break_here, {}}); }

std::vector<std::vector<std::size_t>> Sheets::laid_out() const {
  constexpr double room = a4_height - 2 * margin - foot;
  std::vector<std::vector<std::size_t>> sheets(1);
  double used = 0;
  const auto put = [&](std::size_t k) {
    sheets.back().push_back(k);
    used += items_[k].height;
  };
  for (std::size_t k = 0; k < items_.size(); ++k) {
    // what is not to be the last comes with what it leads to
    double height = items_[k].height;
    for (std::size_t n = k; items_[n].with_next && n + 1 < items_.size(); ++n)
      height += items_[n + 1].height;
    const bool ends = items_[k].height == break_here;
    if ((ends || used + height > room) && used > 0) {
      sheets.emplace_back();
      used = 0;
      if (!ends && items_[k].head != none) put(items_[k].head);
    }
    if (!ends) put(k);
  }
  if (sheets.back().empty() && sheets.size() > 1) sheets.pop_back();
  return sheets;
}

std::string Sheets::pdf() const {
  const auto sheets = laid_out();
  std::vector<DrawOn> drawn;
  for (std::size_t n = 0; n < sheets.size(); ++n)
    drawn.emplace_back([&, n](Canvas& canvas) {
      double y = margin;
      for (const std::size_t k : sheets[n]) {
        if (items_[k].draw) items_[k].draw(canvas, y);
        y += items_[k].height;
      }
      const TextStyle style{.size = 7.5, .colour = grey};
      TextStyle number = style;
      number.align_x = AlignX::right;
      canvas.text(plain(title_), {margin, a4_height - margin}, style);
      canvas.text(fmt::format("{} of {}", n + 1, sheets.size()),
                  {a4_width - margin, a4_height - margin}, number);
    });
  return draw_pdf(a4_width, a4_height, title_, drawn);
}

}  // namespace gridshell::render
