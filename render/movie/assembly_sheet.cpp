#include <fmt/format.h>

#include <algorithm>

#include "render/movie/fabrication_sheets.h"
#include "render/movie/paper.h"

namespace gridshell::render {
namespace {

using exports::CutRod;
using exports::FabricationPlan;
using exports::Pin;

const Colour blue{0.1f, 0.3f, 0.65f, 1};

/// Writes a page's title, smaller if it would not fit.
void draw_title(Canvas& canvas, const std::string& title, double size) {
  canvas.text(plain(title), {a4_margin, a4_margin},
              canvas.fitted(plain(title), a4_width - 2 * a4_margin, {size, ink, true}));
}

void draw_footprint(Canvas& canvas, const FabricationPlan& work, const Box& box) {
  Eigen::Matrix2Xd corners(2, 2 * Eigen::Index(work.rods.size()));
  for (std::size_t r = 0; r < work.rods.size(); ++r) {
    corners.col(2 * Eigen::Index(r)) = work.rods[r].begin;
    corners.col(2 * Eigen::Index(r) + 1) = work.rods[r].end;
  }
  const PlanView fit(box.inset(18), corners);
  canvas.polyline(fit.line(work.original_boundary), {alarm_red, 0.8}, true);
  // names as large as fit without touching one another
  const double size = std::clamp(0.6 * work.spacing_mm * fit.scale, 3.0, 7.0);
  for (const CutRod& rod : work.rods) {
    Eigen::Vector2d from = rod.begin;
    const auto draw_to = [&](const Eigen::Vector2d& to) {
      canvas.line(fit(from), fit(to), {rod.hard_to_build() ? alarm_red : ink, 0.6});
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
  canvas.polyline(fit.line(boundary), {alarm_red, 0.8}, true);
  for (const Pin& pin : work.pins)
    if (pin.in_ring) canvas.circle(fit(pin.at.head<2>()), 1.3, {1, 1, 1, 1}, {ink, 0.7});
  canvas.text(work.has_plate() ? "actuated boundary with its holes, seen from above"
                               : "positions of the ends, seen from above; heights in pins.csv",
              {box.middle().x, box.bottom()}, {7.5, ink, false, AlignX::centre, AlignY::bottom});
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
  const bool laths =
      std::ranges::any_of(work.rods, [](const CutRod& rod) { return rod.section.lath(); });
  const char* bolt = laths ? "bolt" : "tie";
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

std::string assembly_sheet_pdf(const FabricationPlan& work) {
  constexpr double half = (text_width - 16) / 2, step = 14;
  const TextStyle text{9, ink};
  struct Line {
    std::string text;
    Point at;
    TextStyle style;
  };
  std::vector<std::vector<Line>> pages(1);
  double y = a4_margin + half + 70;
  const auto put = [&](const std::string& words, double indent, const TextStyle& style) {
    for (const std::string& one : lines_of(words, text_width - indent, style)) {
      if (y > a4_height - a4_margin) {
        pages.emplace_back();
        y = a4_margin + step;
      }
      pages.back().push_back({plain(one), {a4_margin + indent, y}, style});
      y += step;
    }
  };
  int number = 0;
  for (const std::string& one : steps(work)) {
    put(fmt::format("{}.", ++number), 0, text);
    y -= step;  // the number is in the step's first line
    put(one, 16, text);
    y += 4;
  }
  if (const std::string hard = short_legs(work); !hard.empty()) {
    y += 6;
    put("Hard to build", 0, {9, alarm_red, true});
    put(fmt::format("Legs below {:g} mm leave no room between a joint and the boundary: {}. Leave "
                    "these joints untied, or move the boundary.",
                    exports::shortest_leg_mm, hard),
        0, text);
  }
  std::vector<DrawOn> drawn;
  for (const std::vector<Line>& page : pages)
    drawn.emplace_back([&](Canvas& canvas) {
      if (&page == &pages.front()) {
        draw_title(canvas, work.title + ": assembly", 14);
        canvas.text(fmt::format("{}, joints at every {:g} mm along them", work.section_text(),
                                work.spacing_mm),
                    {a4_margin, a4_margin + 16}, text);
        draw_footprint(canvas, work, {a4_margin, a4_margin + 26, half, half + 10});
        draw_plate(canvas, work, {a4_margin + half + 16, a4_margin + 26, half, half + 10});
      }
      for (const Line& one : page) canvas.text(one.text, one.at, one.style);
    });
  return draw_pdf(a4_width, a4_height, work.title + ": assembly", drawn);
}

}  // namespace gridshell::render
