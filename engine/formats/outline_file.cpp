#include "engine/formats/outline_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/point_grid.h"
#include "engine/core/text.h"
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

/// Lines that are not closed, found by the positions of their ends.
class OpenLines {
 public:
  /// `near`: largest distance of ends that meet.
  OpenLines(std::vector<Line> lines, const Eigen::Vector2d& low, double near)
      : lines_(std::move(lines)), low_(low), near_(near), grid_(std::max(near, 1e-300)) {
    for (std::size_t end = 0; end < 2 * lines_.size(); ++end) grid_.add(int(end), at(point(end)));
  }

  /// Takes out the last line; empty: there is none.
  Line take_last() {
    while (!lines_.empty() && lines_.back().empty()) lines_.pop_back();
    return lines_.empty() ? Line() : std::exchange(lines_.back(), {});
  }
  /// Takes out the line with the end that is nearest to a point, from that end on; empty: no end is
  /// within `near`.
  Line take_next(const Eigen::Vector2d& from) {
    double gap = INFINITY;
    std::size_t next = 0;
    grid_.any_near(at(from), [&](int number) {
      const auto end = std::size_t(number);
      if (end / 2 >= lines_.size() || lines_[end / 2].empty()) return false;
      const double distance = (point(end) - from).norm();
      if (distance <= near_ && (distance < gap || (distance == gap && end < next)))
        gap = distance, next = end;
      return gap == 0;
    });
    if (gap == INFINITY) return {};
    Line line = std::exchange(lines_[next / 2], {});
    if (next % 2 == 1) std::ranges::reverse(line);
    return line;
  }

 private:
  const Eigen::Vector2d& point(std::size_t end) const {
    return end % 2 == 0 ? lines_[end / 2].front() : lines_[end / 2].back();
  }
  Eigen::Vector3d at(const Eigen::Vector2d& p) const {
    return {p.x() - low_.x(), p.y() - low_.y(), 0};
  }

  std::vector<Line> lines_;  // those that were taken out are empty
  Eigen::Vector2d low_;
  double near_;
  PointGrid grid_;
};

/// The smallest distance between ends of chains that do not close; infinite if there are too many
/// chains to compare.
double smallest_gap(const std::vector<Line>& chains) {
  constexpr std::size_t most = 2000;
  double gap = INFINITY;
  for (std::size_t i = 0; i < chains.size() && chains.size() <= most; ++i) {
    const Line& one = chains[i];
    if (one.size() > 2) gap = std::min(gap, (one.front() - one.back()).norm());
    for (std::size_t k = i + 1; k < chains.size(); ++k)
      for (const auto& a : {one.front(), one.back()})
        for (const auto& b : {chains[k].front(), chains[k].back()})
          gap = std::min(gap, (a - b).norm());
  }
  return gap;
}

/// The closed lines of a drawing.
struct Loops {
  std::vector<Line> closed;
  std::size_t open = 0;   ///< number of chains that do not close
  double gap = INFINITY;  ///< the smallest gap between ends of these chains
};

Loops loops_of(const PlanDrawing& drawing, const Eigen::Vector2d& low, double near) {
  Loops loops;
  std::vector<Line> lines, chains;
  const auto take = [&](const Line& line, bool closed) {
    Line points = without_repeats(line, closed ? near : 0);
    if (closed && points.size() > 2)
      loops.closed.push_back(std::move(points));
    else if (points.size() > 1)
      lines.push_back(std::move(points));
  };
  for (const PlanLine& line : drawing.lines) {
    const bool returns =
        line.points.size() > 3 && (line.points.front() - line.points.back()).norm() <= near;
    take(line.points, line.closed || returns);
  }
  OpenLines open(std::move(lines), low, near);
  for (Line chain = open.take_last(); !chain.empty(); chain = open.take_last()) {
    for (;;) {
      if (chain.size() > 2 && (chain.front() - chain.back()).norm() <= near) {
        loops.closed.push_back(without_repeats(chain, near));
        break;
      }
      Line next = open.take_next(chain.back());
      if (next.empty()) {  // perhaps it continues at its other end
        std::ranges::reverse(chain);
        next = open.take_next(chain.back());
      }
      if (next.empty()) {
        chains.push_back(std::move(chain));
        break;
      }
      chain.insert(chain.end(), next.begin() + 1, next.end());
    }
  }
  loops.open = chains.size();
  loops.gap = smallest_gap(chains);
  return loops;
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
                           const std::string& where) -> Result<void> {
    PlanLine& line = drawing.lines.emplace_back();
    line.closed = faces;
    for (const long number : numbers) {
      if (number < 0 || number >= long(points.size()))
        return invalid("{}: got vertex {}, expected at most {}", where, number + 1, points.size());
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
  constexpr double farthest = 1e9;   // coordinate, in the drawing's unit and in mm
  Eigen::AlignedBox2d box;
  for (const PlanLine& line : drawing.lines)
    for (const Eigen::Vector2d& point : line.points) {
      const double far = point.cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
      if (!(far <= farthest && drawing.unit_mm * far <= farthest))
        return invalid("{}: got a coordinate that is too large, expected at most 1e9 mm", name);
      box.extend(point);
    }
  const double size = box.isEmpty() ? 0 : box.diagonal().norm(),
               near = std::max(touching * size, join_mm / drawing.unit_mm);
  const Loops loops = loops_of(drawing, box.min(), near);
  const auto largest = std::ranges::max_element(loops.closed, {}, area_of);
  if (largest == loops.closed.end() || !(area_of(*largest) > touching * size * size)) {
    std::vector<std::string> found;
    if (!loops.closed.empty())
      found.push_back(counted(loops.closed.size(), "closed line") + " without area");
    if (loops.open > 0) found.push_back(counted(loops.open, "open line"));
    if (std::isfinite(loops.gap))
      found.push_back(
          fmt::format("the smallest gap {:.3g} mm: join_mm closes gaps of up to its size",
                      loops.gap * drawing.unit_mm));
    return invalid("{}: got no closed outline{}{}{}", name, found.empty() ? ", and no line" : ": ",
                   fmt::join(found, ", "), drawing.left_out);
  }
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
