#include "engine/formats/outline_file.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/try.h"
#include "engine/formats/obj_ply.h"
#include "engine/formats/plain_text.h"
#include "engine/formats/point_file.h"
#include "engine/formats/svg_file.h"

namespace gridshell::preset {
namespace {

using Line = std::vector<Eigen::Vector2d>;

/// Area inside a closed line, by the shoelace formula.
double area_of(const Line& line) {
  double twice = 0;
  for (std::size_t k = 0; k < line.size(); ++k) {
    const Eigen::Vector2d &a = line[k], &b = line[(k + 1) % line.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * std::abs(twice);
}

Line without_repeats(const Line& line, double near) {
  Line points;
  for (const Eigen::Vector2d& point : line)
    if (points.empty() || (point - points.back()).norm() > near) points.push_back(point);
  while (points.size() > 1 && (points.front() - points.back()).norm() <= near) points.pop_back();
  return points;
}

/// The open line with the end that is nearest to the end of a chain; `reversed`: that end is its
/// last point.
struct Next {
  std::size_t line = 0;
  bool reversed = false;
  double gap = INFINITY;
};
Next next_of(const Line& chain, const std::vector<Line>& open) {
  Next next;
  for (std::size_t k = 0; k < open.size(); ++k)
    for (const bool reversed : {false, true}) {
      const double gap = ((reversed ? open[k].back() : open[k].front()) - chain.back()).norm();
      if (gap < next.gap) next = {k, reversed, gap};
    }
  return next;
}

/// The closed lines of a drawing.
struct Loops {
  std::vector<Line> closed;
  std::size_t open = 0;   ///< number of chains that do not close
  double gap = INFINITY;  ///< the smallest gap between ends of these chains
};

Loops loops_of(const PlanDrawing& drawing, double near) {
  Loops loops;
  std::vector<Line> open;
  const auto take = [&](const Line& line, bool closed) {
    Line points = without_repeats(line, closed ? near : 0);
    if (closed && points.size() > 2)
      loops.closed.push_back(std::move(points));
    else if (points.size() > 1)
      open.push_back(std::move(points));
  };
  for (const PlanLine& line : drawing.lines) {
    const bool returns =
        line.points.size() > 3 && (line.points.front() - line.points.back()).norm() <= near;
    take(line.points, line.closed || returns);
  }
  while (!open.empty()) {
    Line chain = std::move(open.back());
    open.pop_back();
    for (;;) {
      const double gap = (chain.front() - chain.back()).norm();
      if (chain.size() > 2 && gap <= near) {
        loops.closed.push_back(without_repeats(chain, near));
        break;
      }
      Next next = next_of(chain, open);
      if (next.gap > near) {  // perhaps it continues at its other end
        std::ranges::reverse(chain);
        next = next_of(chain, open);
      }
      if (next.gap > near) {
        ++loops.open;
        loops.gap = std::min({loops.gap, next.gap, chain.size() > 2 ? gap : INFINITY});
        break;
      }
      Line& more = open[next.line];
      if (next.reversed) std::ranges::reverse(more);
      chain.insert(chain.end(), more.begin() + 1, more.end());
      open.erase(open.begin() + std::ptrdiff_t(next.line));
    }
  }
  return loops;
}

std::string counted(std::size_t count, const char* what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

Result<PlanDrawing> read_obj_outline(std::string_view bytes, const std::string& name) {
  PlanDrawing drawing;
  drawing.unit = "in mm, as OBJ names no unit";
  std::vector<Eigen::Vector2d> points;
  const auto vertex = [&](const std::vector<double>& xyz, const std::string&) {
    points.emplace_back(xyz[0], xyz[1]);
    return Result<void>();
  };
  bool faces = false;
  const auto element = [&](const std::vector<long>& numbers,
                           const std::string& place) -> Result<void> {
    PlanLine& line = drawing.lines.emplace_back();
    line.closed = faces;
    for (const long number : numbers) {
      if (number < 0 || number >= long(points.size()))
        return invalid("{}: got vertex {}, expected at most {}", place, number + 1, points.size());
      line.points.push_back(points[std::size_t(number)]);
    }
    return {};
  };
  TRY(others, read_obj_lines(bytes, name, "l", {vertex, element}));
  if (drawing.lines.empty()) {
    faces = true;
    points.clear();
    TRY_DO(read_obj_lines(bytes, name, "f", {vertex, element}));
  } else if (const int left = (*others)["f"]; left > 0) {
    drawing.left_out = "; not used: " + counted(std::size_t(left), "face");
  }
  return drawing;
}

}  // namespace

Result<NetworkData> largest_loop(const PlanDrawing& drawing, const std::string& name,
                                 double join_mm, FileReport& report) {
  constexpr double touching = 1e-6;  // distance of ends that meet, over the drawing's size
  Eigen::AlignedBox2d box;
  for (const PlanLine& line : drawing.lines)
    for (const Eigen::Vector2d& point : line.points) box.extend(point);
  const double size = box.isEmpty() ? 0 : box.diagonal().norm(),
               near = std::max(touching * size, join_mm / drawing.unit_mm);
  const Loops loops = loops_of(drawing, near);
  const auto largest = std::ranges::max_element(loops.closed, {}, area_of);
  if (largest == loops.closed.end() || !(area_of(*largest) > touching * size * size))
    return invalid("{}: got no closed outline{}{}", name,
                   loops.open == 0
                       ? ", and no line"
                       : fmt::format(": {}{}", counted(loops.open, "open line"),
                                     std::isfinite(loops.gap)
                                         ? fmt::format(", the smallest gap {:.3g} mm: join_mm "
                                                       "closes gaps of up to its size",
                                                       loops.gap * drawing.unit_mm)
                                         : ""),
                   drawing.left_out);
  NetworkData outline;
  outline.rods.emplace_back();
  for (const Eigen::Vector2d& point : *largest) {
    outline.rods[0].push_back(int(outline.points.size()));
    outline.points.push_back({drawing.unit_mm * point.x(), drawing.unit_mm * point.y(), 0});
  }
  outline.rods[0].push_back(0);
  Eigen::AlignedBox2d around;
  for (const Eigen::Vector2d& point : *largest) around.extend(point);
  const Eigen::Vector2d wide = drawing.unit_mm * around.sizes();
  report.text += fmt::format("an outline of {} points, {:.6g} x {:.6g} mm, {}", largest->size(),
                             wide.x(), wide.y(), drawing.unit);
  std::vector<std::string> others;
  if (loops.closed.size() > 1)
    report.text += fmt::format(", the largest of {} closed lines", loops.closed.size());
  if (loops.open > 0) report.text += ", in addition to " + counted(loops.open, "open line");
  report.text += drawing.left_out;
  return outline;
}

Result<NetworkData> read_outline(std::string_view bytes, const std::string& name,
                                 const NetworkOptions& options, FileReport* report) {
  const std::string ending = ending_of(name);
  FileReport found;
  const auto read = [&]() -> Result<PlanDrawing> {
    if (ending == ".dxf") return read_outline_dxf(bytes, name, options, found);
    if (ending == ".svg") return read_svg(bytes, name);
    if (ending == ".obj") return read_obj_outline(bytes, name);
    return invalid("{}: expected a name that ends in .dxf, .svg or .obj (a closed outline)", name);
  };
  TRY(drawing, read());
  if (options.unit_mm > 0 && ending != ".dxf") {
    drawing->unit_mm = options.unit_mm;
    drawing->unit = "unit by file_unit";
  }
  TRY(outline, largest_loop(*drawing, name, options.join_mm, found));
  found.text = name + ": " + found.text;
  if (report) *report = std::move(found);
  return std::move(*outline);
}

}  // namespace gridshell::preset
