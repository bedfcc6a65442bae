#include "render/movie/fabrication_sheets.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <utility>

#include "render/movie/paper.h"

namespace gridshell::render {
namespace {

constexpr double foot = 20, line = 12, between = 8;  // points
const Colour grey{0.45f, 0.45f, 0.48f, 1};
const TextStyle usual{.size = 8.5};

/// The left edge and the width of every column.
std::vector<std::pair<double, double>> column_spans(const std::vector<TableColumn>& columns) {
  constexpr double gap = 8;
  double known = gap * double(columns.size() - 1);
  for (const TableColumn& column : columns) known += column.width;
  std::vector<std::pair<double, double>> spans;
  double x = a4_margin;
  for (const TableColumn& column : columns) {
    const double width = column.width > 0 ? column.width : text_width - known;
    spans.emplace_back(x, width);
    x += width + gap;
  }
  return spans;
}

void draw_cell(Canvas& canvas, const std::string& marked, const std::pair<double, double>& span,
               double y, TextStyle style) {
  const auto [x, width] = span;
  const Point at{style.align_x == AlignX::right ? x + width : x, y + line - 3};
  canvas.text(marked, at, canvas.fitted(marked, width, style));
}

using exports::CutRod;
using exports::FabricationPlan;

std::string marks_of(const CutRod& rod) {
  std::string marks;
  for (const double mark : rod.joint_marks_mm)
    marks += fmt::format("{}{:.1f}", marks.empty() ? "" : "  ", mark);
  for (const double splice : rod.splices_mm)
    marks +=
        fmt::format("{}{:.1f}", splice == rod.splices_mm.front() ? "; splice at " : "  ", splice);
  return marks;
}

/// The rod with its marks measured from the other end.
CutRod turned(CutRod rod) {
  for (auto* marks : {&rod.joint_marks_mm, &rod.splices_mm}) {
    std::ranges::reverse(*marks);
    for (double& mark : *marks) mark = rod.length_mm - mark;
  }
  return rod;
}

/// Number, names, section, length and marks of equal rods; names of rods that are measured from
/// their other end have a *.
std::vector<TableRow> cut_list(const FabricationPlan& work) {
  std::vector<TableRow> rows;
  std::vector<int> numbers;
  for (const CutRod& rod : work.rods) {
    const std::string section = rod.section.text(), length = fmt::format("{:.1f}", rod.length_mm),
                      marks = marks_of(rod), mirrored = marks_of(turned(rod));
    const auto equal = [&](const std::string& as) {
      return std::ranges::find_if(rows, [&](const TableRow& row) {
        return row.cells[2] == section && row.cells[3] == length && row.cells[4] == as &&
               row.highlighted == rod.hard_to_build();
      });
    };
    auto same = equal(marks);
    const bool from_other_end = same == rows.end() && equal(mirrored) != rows.end();
    if (from_other_end) same = equal(mirrored);
    if (same == rows.end()) {
      rows.push_back({{"", rod.name, section, length, marks}, rod.hard_to_build()});
      numbers.push_back(1);
      continue;
    }
    same->cells[1] += ", " + rod.name + (from_other_end ? "*" : "");
    ++numbers[std::size_t(same - rows.begin())];
  }
  for (std::size_t k = 0; k < rows.size(); ++k) rows[k].cells[0] = std::to_string(numbers[k]);
  return rows;
}

}  // namespace

std::vector<std::string> lines_of(const std::string& text, double width, const TextStyle& style) {
  std::vector<std::string> lines;
  (void)draw_picture(8, 8, 1, white,
                     [&](Canvas& canvas) { lines = canvas.wrapped(text, width, style); });
  return lines;
}

void Sheets::heading(const std::string& plain_text, double size) {
  add({1.9 * size,
       [=](Canvas& canvas, double y) {
         const TextStyle style{.size = size, .bold = true};
         canvas.text(plain(plain_text), {a4_margin, y + 1.4 * size},
                     canvas.fitted(plain(plain_text), text_width, style));
       },
       true});
}

void Sheets::text(const std::string& plain_text) {
  for (const std::string& words : lines_of(plain_text, text_width, usual))
    add({line, [=](Canvas& canvas, double y) {
           canvas.text(plain(words), {a4_margin, y + line - 3}, usual);
         }});
  add({between / 2, {}});
}

void Sheets::table(const std::vector<TableColumn>& columns, const std::vector<TableRow>& rows) {
  constexpr std::size_t most_together = 20;  // lines of a row
  const auto spans = column_spans(columns);
  const std::size_t head = items_.size();
  add({line + 3,
       [=](Canvas& canvas, double y) {
         for (std::size_t k = 0; k < columns.size(); ++k)
           draw_cell(canvas, columns[k].title, spans[k], y,
                     {.size = usual.size, .bold = true, .align_x = columns[k].align});
         canvas.line({a4_margin, y + line + 1}, {a4_width - a4_margin, y + line + 1}, {ink, 0.6});
       },
       true});
  for (const TableRow& row : rows) {
    std::vector<std::vector<std::string>> cells;
    std::size_t lines = 1;
    for (std::size_t k = 0; k < row.cells.size(); ++k) {
      const bool broken = columns[k].width == 0 || columns[k].align == AlignX::left;
      cells.push_back(broken ? lines_of(row.cells[k], spans[k].second, usual)
                             : std::vector<std::string>{row.cells[k]});
      lines = std::max(lines, cells.back().size());
    }
    // only a row higher than most may continue on the next sheet
    for (std::size_t n = 0; n < lines; ++n)
      add({line,
           [=, colour = row.highlighted ? alarm_red : ink](Canvas& canvas, double y) {
             for (std::size_t k = 0; k < cells.size(); ++k)
               if (n < cells[k].size())
                 draw_cell(canvas, plain(cells[k][n]), spans[k], y,
                           {.size = usual.size, .colour = colour, .align_x = columns[k].align});
           },
           lines <= most_together && n + 1 < lines, head});
  }
  add({between, {}});
}

void Sheets::values(const std::vector<std::pair<std::string, std::string>>& pairs) {
  constexpr double half = text_width / 2, name = 0.5 * half;
  for (std::size_t k = 0; k < pairs.size(); k += 2)
    add({line, [=](Canvas& canvas, double y) {
           for (std::size_t n = k; n < std::min(k + 2, pairs.size()); ++n) {
             const double x = a4_margin + (n == k ? 0 : half);
             draw_cell(canvas, plain(pairs[n].first), {x, name - 6}, y,
                       {.size = usual.size, .colour = grey});
             draw_cell(canvas, plain(pairs[n].second), {x + name, half - name - 8}, y, usual);
           }
         }});
  add({between, {}});
}

void Sheets::pictures(const std::vector<Image>& images) {
  const double count = double(images.size()), each = (text_width - (count - 1) * between) / count,
               height = each * images.front().height / images.front().width;
  add({height + between, [=](Canvas& canvas, double y) {
         for (std::size_t k = 0; k < images.size(); ++k)
           canvas.picture(images[k], {a4_margin + double(k) * (each + between), y, each, height});
       }});
}

void Sheets::plot(const Plot& plot, double height) {
  add({height + between, [=](Canvas& canvas, double y) {
         draw_plot(canvas, {a4_margin, y, text_width, height}, plot);
       }});
}

void Sheets::next_sheet() { add({break_here, {}}); }

std::vector<std::vector<std::size_t>> Sheets::laid_out() const {
  constexpr double room = a4_height - 2 * a4_margin - foot;
  std::vector<std::vector<std::size_t>> sheets(1);
  double used = 0;
  const auto put = [&](std::size_t k) {
    sheets.back().push_back(k);
    used += items_[k].height;
  };
  for (std::size_t k = 0; k < items_.size(); ++k) {
    // an item that must be with the next one needs the height of both
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
      double y = a4_margin;
      for (const std::size_t k : sheets[n]) {
        if (items_[k].draw) items_[k].draw(canvas, y);
        y += items_[k].height;
      }
      const TextStyle style{.size = 7.5, .colour = grey};
      TextStyle number = style;
      number.align_x = AlignX::right;
      canvas.text(plain(title_), {a4_margin, a4_height - a4_margin}, style);
      canvas.text(fmt::format("{} of {}", n + 1, sheets.size()),
                  {a4_width - a4_margin, a4_height - a4_margin}, number);
    });
  return draw_pdf(a4_width, a4_height, title_, drawn);
}

void add_cut_list(Sheets& sheets, const FabricationPlan& work) {
  sheets.text(
      fmt::format("{} {}, {:.2f} m in all; marks in mm from the start of each, of rods with * "
                  "from its end. Red: a leg below {:g} mm.",
                  work.rods.size(), work.section_text(), 1e-3 * work.total_length_mm(),
                  exports::shortest_leg_mm));
  std::vector<TableRow> rows = cut_list(work);
  sheets.table({{"number", 36},
                {"rods", 110, AlignX::left},
                {"section", 70, AlignX::left},
                {"length (mm)", 60},
                {"joints (mm)", 0, AlignX::left}},
               rows);
}

std::string cut_list_text(const FabricationPlan& work) {
  std::string text;
  for (const TableRow& row : cut_list(work))
    text += fmt::format("{}\n", fmt::join(row.cells, "  "));
  return text;
}

std::string cut_list_pdf(const FabricationPlan& work) {
  Sheets sheets(work.title + ": cut list");
  sheets.heading(work.title + ": cut list", 13);
  add_cut_list(sheets, work);
  return sheets.pdf();
}

}  // namespace gridshell::render
