#include "engine/record/fabrication.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/formats/csv.h"

namespace gridshell::exports {
namespace {

constexpr double label_height_mm = 3, joint_mark_mm = 2;

Eigen::Vector3d flat(const Eigen::Vector2d& at) { return {at.x(), at.y(), 0}; }

/// Adds a closed boundary to a layer: a circle if it has a radius, else its polyline.
void put_boundary(const Eigen::Matrix2Xd& polyline, double radius_mm, Layer& layer) {
  if (std::isfinite(radius_mm)) {
    layer.circles.push_back({Eigen::Vector2d::Zero(), radius_mm});
    return;
  }
  DrawnLine line{{}, true};
  for (Eigen::Index k = 0; k < polyline.cols(); ++k) line.points.push_back(flat(polyline.col(k)));
  layer.lines.push_back(std::move(line));
}

std::string space_separated(const std::vector<double>& numbers) {
  std::string row;
  for (const double number : numbers) row += fmt::format("{}{}", row.empty() ? "" : " ", number);
  return row;
}

/// The value rounded to a multiple of `step`. Where 1/step is an integer, the division by it leaves
/// no digits of round-off.
double to_step(double value, double step) {
  const double count = std::round(value / step), whole = std::round(1 / step);
  return std::abs(whole * step - 1) < 1e-9 ? count / whole : count * step;
}

}  // namespace

Eigen::Vector2d FabricationPlan::middle() const {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& joint : joints) sum += joint;
  return sum / double(joints.size());
}

Eigen::Vector2d FabricationPlan::label_position(const CutRod& rod, double away) const {
  const Eigen::Vector2d along = (rod.end - rod.begin).normalized(), left(-along.y(), along.x());
  return left.dot(rod.begin - middle()) >= 0 ? Eigen::Vector2d(rod.begin - away * along)
                                             : Eigen::Vector2d(rod.end + away * along);
}

double FabricationPlan::total_length_mm() const {
  double sum = 0;
  for (const CutRod& rod : rods) sum += rod.length_mm;
  return sum;
}

FabricationPlan rounded(FabricationPlan plan, double step_mm) {
  if (!(step_mm > 0)) return plan;
  const auto round = [&](double value) { return to_step(value, step_mm); };
  for (CutRod& rod : plan.rods) {
    double begin = 0, end = rod.length_mm;  // positions of its edge points
    if (!rod.joint_marks_mm.empty())
      for (const double pin : rod.pin_marks_mm)
        (pin < std::ranges::min(rod.joint_marks_mm) ? begin : end) = pin;
    rod.length_mm = round(rod.length_mm);
    for (auto* marks : {&rod.joint_marks_mm, &rod.pin_marks_mm, &rod.splices_mm})
      for (double& mark : *marks) mark = round(mark);
    if (rod.joint_marks_mm.empty()) continue;
    const auto [first, last] = std::ranges::minmax(rod.joint_marks_mm);
    if (std::isfinite(rod.leg_begin_mm)) rod.leg_begin_mm = round(first - round(begin));
    if (std::isfinite(rod.leg_end_mm)) rod.leg_end_mm = round(round(end) - last);
  }
  return plan;
}

Result<FabricationPlan> spliced(FabricationPlan plan, double stock_mm) {
  for (CutRod& rod : plan.rods) {
    if (stock_mm == 0 || rod.length_mm <= stock_mm) continue;
    std::vector<double> stops{0};  // ends and joints; splices are in the middle between two of them
    stops.insert(stops.end(), rod.joint_marks_mm.begin(), rod.joint_marks_mm.end());
    stops.push_back(rod.length_mm);
    for (double from = 0; rod.length_mm - from > stock_mm;) {
      double to = from;
      for (std::size_t k = 1; k < stops.size(); ++k)
        if (const double middle = 0.5 * (stops[k - 1] + stops[k]); middle <= from + stock_mm)
          to = std::max(to, middle);
      if (to <= from)
        return invalid(
            "[figure] stock_mm: got {:g}, expected more: joints of rod {} are further apart",
            stock_mm, rod.name);
      rod.splices_mm.push_back(from = to);
    }
  }
  return plan;
}

Drawing footprint_drawing(const FabricationPlan& work) {
  Layer rods{"rods", 7}, tails{"tails", 3}, joints{"joints", 5}, boundary{"boundary", 1},
      labels{"labels", 5};
  for (const CutRod& rod : work.rods) {
    DrawnLine line{{flat(rod.begin)}};
    for (const Eigen::Vector2d& corner : rod.corners) line.points.push_back(flat(corner));
    line.points.push_back(flat(rod.end));
    rods.lines.push_back(std::move(line));
    const Eigen::Vector2d along = (rod.end - rod.begin).normalized(), across(-along.y(), along.x());
    for (const double mark : rod.pin_marks_mm) {
      const Eigen::Vector2d at = rod.begin + mark * along;
      tails.lines.push_back({{flat(at - across), flat(at + across)}});
    }
    labels.texts.push_back(
        {work.label_position(rod, 2 * label_height_mm), label_height_mm, rod.name});
  }
  const Eigen::Vector2d x(joint_mark_mm / 2, 0), y(0, joint_mark_mm / 2);
  for (const Eigen::Vector2d& at : work.joints) {
    joints.lines.push_back({{flat(at - x), flat(at + x)}});
    joints.lines.push_back({{flat(at - y), flat(at + y)}});
  }
  put_boundary(work.original_boundary, work.original_radius_mm, boundary);
  Drawing drawing{work.title + ": footprint", {rods}};
  if (!tails.lines.empty()) drawing.layers.push_back(tails);
  for (const Layer& layer : {joints, boundary, labels}) drawing.layers.push_back(layer);
  return drawing;
}

std::string CutSection::text() const {
  std::string all = lath() ? fmt::format("{:g} x {:g} mm", width_mm, thickness_mm)
                           : fmt::format("{:g} mm diameter", diameter_mm);
  if (wall_mm > 0) all += fmt::format(", {:g} mm wall", wall_mm);
  return all;
}

std::string FabricationPlan::section_text() const {
  constexpr std::size_t most = 4;  // sections that are named; the cut list has them all
  std::vector<std::pair<CutSection, int>> kinds;
  for (const CutRod& rod : rods) {
    const auto known = std::ranges::find(kinds, rod.section, &std::pair<CutSection, int>::first);
    if (known != kinds.end())
      ++known->second;
    else
      kinds.emplace_back(rod.section, 1);
  }
  const bool laths =
      std::ranges::all_of(rods, [](const CutRod& rod) { return rod.section.lath(); });
  const std::string noun = laths ? "laths" : "rods";
  if (kinds.size() == 1) return noun + " of " + kinds[0].first.text();
  if (kinds.size() > most) return fmt::format("{} of {} sections", noun, kinds.size());
  std::string text = noun + ":";
  for (const auto& [section, count] : kinds)
    text += fmt::format("{} {} of {}", text.back() == ':' ? "" : ",", count, section.text());
  return text;
}

std::pair<double, double> FabricationPlan::heights_of_pins() const {
  double low = INFINITY, high = -INFINITY;
  for (const Pin& pin : pins)
    if (pin.in_ring) low = std::min(low, pin.at.z()), high = std::max(high, pin.at.z());
  return {low, high};
}

bool FabricationPlan::has_plate() const {
  const auto [low, high] = heights_of_pins();
  return low <= high && high - low <= 1e-3;
}

Result<Drawing> plate_drawing(const FabricationPlan& work) {
  const auto [low, high] = work.heights_of_pins();
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  int pins = 0;
  for (const Pin& pin : work.pins) {
    if (!pin.in_ring) continue;
    middle += pin.at.head<2>();
    ++pins;
  }
  if (pins == 0) return invalid("nothing is pinned, so there is no plate");
  if (!work.has_plate())
    return invalid(
        "the edge points lie between z = {:.3f} and {:.3f} mm, so no flat plate carries them; "
        "'--what plate --to pins.csv' lists them",
        low, high);
  middle /= pins;
  Layer boundary{"boundary", 1}, holes{"holes", 7}, labels{"labels", 5};
  put_boundary(work.actuated_boundary.topRows<2>(), work.actuated_radius_mm, boundary);
  for (const Pin& pin : work.pins) {
    if (!pin.in_ring) continue;
    const Eigen::Vector2d at = pin.at.head<2>();
    holes.circles.push_back({at, pin.hole_mm / 2});
    labels.texts.push_back(
        {at + 2 * label_height_mm * (at - middle).normalized(), 0.6 * label_height_mm, pin.name});
  }
  return Drawing{work.title + ": plate", {boundary, holes, labels}};
}

std::string cut_list_csv(const FabricationPlan& work) {
  record::CsvWriter csv;
  csv.line("rod", "length_mm", "joint_marks_mm", "pin_marks_mm", "leg_begin_mm", "leg_end_mm",
           "splices_mm", "note", "section");
  for (const CutRod& rod : work.rods)
    csv.line(rod.name, rod.length_mm, space_separated(rod.joint_marks_mm),
             space_separated(rod.pin_marks_mm), rod.leg_begin_mm, rod.leg_end_mm,
             space_separated(rod.splices_mm),
             rod.hard_to_build()
                 ? fmt::format("a leg below {:g} mm: hard to build", shortest_leg_mm)
                 : std::string(),
             rod.section.text());
  return std::move(csv).text();
}

std::string pins_csv(const FabricationPlan& work) {
  record::CsvWriter csv;
  csv.line("pin", "ring", "x_mm", "y_mm", "z_mm");
  for (const Pin& pin : work.pins)
    csv.line(pin.name, pin.in_ring ? "first" : "second", pin.at.x(), pin.at.y(), pin.at.z());
  return std::move(csv).text();
}

}  // namespace gridshell::exports
