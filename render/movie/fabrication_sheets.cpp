#include "render/movie/fabrication_sheets.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <utility>

#include "render/canvas/text.h"

namespace gridshell::render {
namespace {

constexpr double a4_width = 595.28, a4_height = 841.89, margin = 42, foot = 20;  // points
constexpr double wide = a4_width - 2 * margin, line = 12, between = 8;
const Colour red{0.7f, 0.1f, 0.1f, 1}, grey{0.45f, 0.45f, 0.48f, 1};
const TextStyle usual{.size = 8.5};

/// Breaks text into lines before a sheet exists.
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

using exports::CutRod;
using exports::FabricationPlan;
using exports::Pin;

const Colour blue{0.1f, 0.3f, 0.65f, 1};

/// Writes a page's title, smaller if it would not fit.
void draw_title(Canvas& canvas, const std::string& title, double size) {
  canvas.text(plain(title), {margin, margin},
              canvas.fitted(plain(title), a4_width - 2 * margin, {size, ink, true}));
}

void draw_footprint(Canvas& canvas, const FabricationPlan& work, const Box& box) {
  Eigen::Matrix2Xd corners(2, 2 * Eigen::Index(work.rods.size()));
  for (std::size_t r = 0; r < work.rods.size(); ++r) {
    corners.col(2 * Eigen::Index(r)) = work.rods[r].begin;
    corners.col(2 * Eigen::Index(r) + 1) = work.rods[r].end;
  }
  const PlanView fit(box.inset(18), corners);
  canvas.polyline(fit.line(work.original_boundary), {red, 0.8}, true);
  // names as large as fit without touching one another
  const double size = std::clamp(0.6 * work.spacing_mm * fit.scale, 3.0, 7.0);
  for (const CutRod& rod : work.rods) {
    Eigen::Vector2d from = rod.begin;
    const auto draw_to = [&](const Eigen::Vector2d& to) {
      canvas.line(fit(from), fit(to), {rod.hard_to_build() ? red : ink, 0.6});
      from = to;
    };
    for (const Eigen::Vector2d& corner : rod.corners) draw_to(corner);
    draw_to(rod.end);
    const Point at = fit(work.label_position(rod, 1.3 * size / fit.scale));
    canvas.text(rod.name, at, {size, ink, false, AlignX::centre, AlignY::middle});
  }
  for (const Eigen::Vector2d& joint : work.joints) canvas.circle(fit(joint), 1.1, blue);
  canvas.text("footprint, seen from above; u-rods begin at the left, v-rods below",
              {box.middle().x, box.bottom()}, {7.5, ink, false, AlignX::centre, AlignY::bottom});
}

void draw_plate(Canvas& canvas, const FabricationPlan& work, const Box& box) {
  const Eigen::Matrix2Xd boundary = work.actuated_boundary.topRows<2>();
  const PlanView fit(box.inset(18), boundary);
  canvas.polyline(fit.line(boundary), {red, 0.8}, true);
  for (const Pin& pin : work.pins)
    if (pin.in_ring) canvas.circle(fit(pin.at.head<2>()), 1.3, {1, 1, 1, 1}, {ink, 0.7});
  canvas.text(work.has_plate() ? "actuated boundary with its holes, seen from above"
                               : "positions of the ends, seen from above; heights in pins.csv",
              {box.middle().x, box.bottom()}, {7.5, ink, false, AlignX::centre, AlignY::bottom});
}

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

/// Number, names, length and marks of equal rods; names of rods that are measured from their other
/// end have a *.
std::vector<TableRow> cut_list(const FabricationPlan& work) {
  std::vector<TableRow> rows;
  std::vector<int> numbers;
  for (const CutRod& rod : work.rods) {
    const std::string length = fmt::format("{:.1f}", rod.length_mm), marks = marks_of(rod),
                      mirrored = marks_of(turned(rod));
    const auto equal = [&](const std::string& as) {
      return std::ranges::find_if(rows, [&](const TableRow& row) {
        return row.cells[2] == length && row.cells[3] == as &&
               row.stands_out == rod.hard_to_build();
      });
    };
    auto same = equal(marks);
    const bool from_other_end = same == rows.end() && equal(mirrored) != rows.end();
    if (from_other_end) same = equal(mirrored);
    if (same == rows.end()) {
      rows.push_back({{"", rod.name, length, marks}, rod.hard_to_build()});
      numbers.push_back(1);
      continue;
    }
    same->cells[1] += ", " + rod.name + (from_other_end ? "*" : "");
    ++numbers[std::size_t(same - rows.begin())];
  }
  for (std::size_t k = 0; k < rows.size(); ++k) rows[k].cells[0] = std::to_string(numbers[k]);
  return rows;
}

std::string short_legs(const FabricationPlan& work) {
  std::string names;
  for (const CutRod& rod : work.rods)
    if (rod.hard_to_build())
      names += fmt::format("{}{} ({:.1f} mm)", names.empty() ? "" : ", ", rod.name,
                           std::min(rod.leg_begin_mm, rod.leg_end_mm));
  return names;
}

std::vector<std::string> steps(const FabricationPlan& work) {
  const auto ring_pins = std::ranges::count(work.pins, true, &Pin::in_ring);
  const auto far_pins = long(work.pins.size()) - ring_pins;
  constexpr double largest_print_mm = 3000;  // largest footprint that is printed at full size
  const double extent =
      (work.original_boundary.rowwise().maxCoeff() - work.original_boundary.rowwise().minCoeff())
          .maxCoeff();
  const auto spliced =
      std::ranges::count_if(work.rods, [](const CutRod& rod) { return !rod.splices_mm.empty(); });
  const char* bolt = work.width_mm > 0 ? "bolt" : "tie";
  std::vector<std::string> list{
      fmt::format("Cut {} {}, {:.2f} m in all, to the lengths of the cut list{}; write its name on "
                  "each.",
                  work.rods.size(), work.section_text(), 1e-3 * work.total_length_mm(),
                  spliced > 0
                      ? fmt::format(", {} of them of pieces that meet at its splices", spliced)
                      : std::string()),
      "Mark the joints on each rod at the distances of the cut list, measured from its start: the "
      "left of a u-rod, the lower end of a v-rod.",
      fmt::format("{}, lay the u-rods on it, the v-rods over them, and {} them at all {} crossings "
                  "so that they can turn but not slide.",
                  extent > largest_print_mm
                      ? "Set the footprint out on the ground (export --what footprint)"
                      : "Print the footprint at full size (export --what footprint)",
                  bolt, work.joints.size())};
  if (work.has_plate()) {
    list.push_back(fmt::format("Drill the {} holes of the actuated boundary (export --what plate).",
                               ring_pins));
    list.emplace_back(
        "Put the ends into their holes, opposite ones in turn from the middle outwards. Fix the "
        "middle up while the first ones go in: a flat grid may also buckle down.");
  } else if (ring_pins > 0) {
    const auto [low, high] = work.heights_of_pins();
    list.push_back(fmt::format(
        "Make {} supports at the positions of 'export --what plate --to pins.csv': their "
        "heights differ by up to {:.0f} mm, so no flat plate carries them.",
        ring_pins, high - low));
    list.emplace_back(
        "Bring the grid up and fix its ends to the supports, opposite ones in turn from the middle "
        "outwards; prop its middle until all are fixed.");
  }
  if (far_pins > 0)
    list.push_back(
        fmt::format("Fix the {} far ends at the positions of the second ring, which do not lie in "
                    "the plate (export --what plate --to pins.csv).",
                    far_pins));
  list.insert(list.end(), work.hand.begin(), work.hand.end());
  return list;
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

void Sheets::pictures(const std::vector<Image>& images) {
  const double count = double(images.size()), each = (wide - (count - 1) * between) / count,
               height = each * images.front().height / images.front().width;
  add({height + between, [=](Canvas& canvas, double y) {
         for (std::size_t k = 0; k < images.size(); ++k)
           canvas.picture(images[k], {margin + double(k) * (each + between), y, each, height});
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

void add_cut_list(Sheets& sheets, const FabricationPlan& work) {
  sheets.text(
      fmt::format("{} {}, {:.2f} m in all; marks in mm from the start of each, of rods with * "
                  "from its end. Red: a leg below {:g} mm.",
                  work.rods.size(), work.section_text(), 1e-3 * work.total_length_mm(),
                  exports::shortest_leg_mm));
  std::vector<TableRow> rows = cut_list(work);
  sheets.table({{"number", 36},
                {"rods", 110, AlignX::left},
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

std::string assembly_sheet_pdf(const FabricationPlan& work) {
  const DrawOn draw = [&](Canvas& canvas) {
    const double wide = a4_width - 2 * margin, half = (wide - 16) / 2;
    const TextStyle text{9, ink};
    draw_title(canvas, work.title + ": assembly", 14);
    canvas.text(
        fmt::format("{}, joints at every {:g} mm along them", work.section_text(), work.spacing_mm),
        {margin, margin + 16}, text);
    draw_footprint(canvas, work, {margin, margin + 26, half, half + 10});
    draw_plate(canvas, work, {margin + half + 16, margin + 26, half, half + 10});
    double y = margin + half + 70;
    const auto put = [&](const std::string& words, double indent) {
      for (const std::string& line : canvas.wrapped(words, wide - indent, text)) {
        canvas.text(plain(line), {margin + indent, y}, text);
        y += 14;
      }
    };
    int number = 0;
    for (const std::string& step : steps(work)) {
      canvas.text(fmt::format("{}.", ++number), {margin, y}, text);
      put(step, 16);
      y += 4;
    }
    const std::string hard = short_legs(work);
    if (hard.empty()) return;
    y += 6;
    canvas.text("Hard to build", {margin, y}, {9, red, true});
    y += 14;
    put(fmt::format("Legs below {:g} mm leave no room between a joint and the boundary: {}. Leave "
                    "these joints untied, or move the boundary.",
                    exports::shortest_leg_mm, hard),
        0);
  };
  return draw_pdf(a4_width, a4_height, work.title + ": assembly", {draw});
}

}  // namespace gridshell::render
